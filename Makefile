# Thin fronts of CMake. Each target does all set-up that it needs, on a bare Debian 12 too.
.PHONY: demo test build setup format clean

demo: setup
	cmake --preset release
	cmake --build --preset release --target berth
	build/release/berth demo --picture build/demo

test: build
	ctest --preset release -j2

build: setup
	cmake --preset release
	cmake --build --preset release

setup:
	scripts/setup.sh

format:
	git ls-files '*.hpp' '*.cpp' | xargs clang-format -i

clean:
	rm -rf build
