# The libraries of the house; also what an installed berth asks of its user (berthConfig.cmake includes this file).
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(Threads REQUIRED)
find_package(assimp REQUIRED)
find_package(fmt REQUIRED)
find_package(pugixml REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
# console_bridge, which urdfdom writes its messages to: not every urdfdom names it to the linker (ROS 2's does not).
pkg_check_modules(berth_urdfdom REQUIRED IMPORTED_TARGET urdfdom console_bridge)
pkg_check_modules(berth_spng REQUIRED IMPORTED_TARGET spng)
pkg_check_modules(berth_hwy REQUIRED IMPORTED_TARGET libhwy)
