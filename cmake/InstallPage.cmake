# A script of `cmake --install`: takes the page (folder `page`) along to `destination`, or says what to do where it was not built.
if(EXISTS ${page}/index.html)
  file(INSTALL ${page} DESTINATION ${destination})
else()
  message(WARNING "The page is not installed, since it is not built: `berth view` and Python's berth.view() of this install will refuse. "
                  "Build it (`cmake --build . --target berth_page`, which needs npm: scripts/packages-page.txt) and install again.")
endif()
