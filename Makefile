# Thin fronts of CMake. Each target does all set-up that it needs, on a bare Debian 12 too.
.PHONY: demo test build bench study setup format clean

demo: setup
	cmake --preset release
	cmake --build --preset release --target berth
	build/release/berth demo --picture build/demo

test: build
	ctest --preset release -j2

build: setup
	cmake --preset release
	cmake --build --preset release

# BERTH_DATA: a folder with recordings to measure as well, here and below. BENCH_OPTIONS: of `berth bench`, such as --quick.
recordings = $(addprefix --scene ,$(wildcard $(BERTH_DATA)/recordings/*/scene.yaml))
bench:
	scripts/setup.sh packages.txt packages-bench.txt
	cmake --preset bench
	cmake --build --preset bench
	build/bench/berth bench --out build/bench_results $(if $(BERTH_DATA),$(recordings)) $(BENCH_OPTIONS)
	bench/plot.py build/bench_results/bench.csv build/bench_results/results.svg

# STUDY_OPTIONS: of `berth study`, such as --quick. A study that was stopped goes on.
study: setup
	cmake --preset release
	cmake --build --preset release --target berth
	build/release/berth study --out build/study $(if $(BERTH_DATA),$(recordings)) $(STUDY_OPTIONS)

setup:
	scripts/setup.sh

format:
	git ls-files '*.hpp' '*.cpp' | xargs clang-format -i

clean:
	rm -rf build
