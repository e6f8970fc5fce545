# Thin fronts of CMake. Each target does all set-up that it needs, on a bare Debian 12 too.
.PHONY: demo test build bench study bench-gpu sanitize sanitize-thinned fuzz trust trust-distances trust-real-images trust-long-runs trust-whole-robot setup format clean

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

# Both on OpenGL. GL_DEVICE: as for `berth run --gl-device`; results.md is ready for bench/RESULTS.md.
gl_device = $(if $(GL_DEVICE),--gl-device "$(GL_DEVICE)")
bench-gpu:
	scripts/setup.sh packages.txt packages-bench.txt
	cmake --preset bench
	cmake --build --preset bench --target berth
	build/bench/berth bench --backend opengl $(gl_device) --out build/bench_gpu \
	  $(if $(BERTH_DATA),$(recordings)) $(BENCH_OPTIONS)
	build/bench/berth study --backend opengl $(gl_device) --out build/bench_gpu/study \
	  $(if $(BERTH_DATA),$(recordings)) $(STUDY_OPTIONS)
	bench/gpu_results.py build/bench_gpu

# The tests under AddressSanitizer and UBSan, then under ThreadSanitizer: all, or readers and what has threads.
sanitize: sanitize-asan sanitize-tsan
sanitize-%: setup
	cmake --preset $*
	cmake --build --preset $*
	ctest --preset $* -j2
sanitize-thinned: sanitize-thinned-asan sanitize-thinned-tsan
sanitize-thinned-%: setup
	cmake --preset $*
	cmake --build --preset $* --target $*_thinned
	ctest --preset $* -j2 --label-regex $* --no-tests=error

# Each reader of a file under libFuzzer, for so many seconds each.
FUZZ_SECONDS ?= 300
fuzz:
	scripts/fuzz.sh "$(FUZZ_SECONDS)"

# What `make test` shows thinned, in full. TRUST_OPTIONS: of measure_trust, such as --scenes 20.
trust: trust-distances trust-real-images trust-long-runs trust-whole-robot
trust-distances: build
	build/release/tools/measure_trust/measure_trust $(if $(BERTH_DATA),--robots $(BERTH_DATA)/robots) $(TRUST_OPTIONS)
trust-real-images: build
ifneq ($(BERTH_DATA),)
	build/release/tools/measure_trust/measure_trust --robots $(BERTH_DATA)/robots --real-images $(BERTH_DATA)/depth $(TRUST_OPTIONS)
else
	@echo "trust-real-images: skipped; BERTH_DATA=FOLDER names the folder with robots/ and depth/"
endif
trust-long-runs: build
	BERTH_LONG_RUN=full build/release/tests/pipeline/long_run_test
trust-whole-robot: build
	BERTH_MESH_TWIN=full build/release/tests/truth/mesh_distances_test
	build/release/tools/measure_trust/measure_trust --whole-robot $(if $(BERTH_DATA),--robots $(BERTH_DATA)/robots) $(TRUST_OPTIONS)

setup:
	scripts/setup.sh

format:
	git ls-files '*.hpp' '*.cpp' | xargs clang-format -i

clean:
	rm -rf build
