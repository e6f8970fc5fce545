# cmake -P: a public header a line, on standard error as message() does.
include(${CMAKE_CURRENT_LIST_DIR}/PublicHeaders.cmake)
foreach(header IN LISTS BERTH_PUBLIC_HEADERS)
  message(${header})
endforeach()
