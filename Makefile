# Thin fronts of CMake. Each target does all set-up that it needs, on a bare Debian 12 too.
.PHONY: demo view opengl python test test-ros2 build bench figures lab study closed-loop bench-gpu sanitize sanitize-thinned fuzz trust berth_trust trust-distances trust-real-images trust-long-runs trust-sequences trust-streams trust-whole-robot trust-contact setup evidence docs site release deb wheel test-debian13 test-arm64 ros-release lint format clean

# A fresh build folder is configured for berth alone, which needs the fewest packages. One that has more keeps it.
product = test -e build/release/build.ninja || cmake --preset product
demo:
	scripts/setup.sh packages.txt
	$(product)
	cmake --build --preset release --target berth
	build/release/berth demo --picture build/demo

# Adds OpenGL to what build/release has.
opengl:
	scripts/setup.sh packages.txt packages-opengl.txt
	$(product)
	cmake -B build/release -DBERTH_OPENGL=ON
	cmake --build --preset release --target berth

# The page that shows a scene: adds it to what build/release has, and opens the bundled scene. Who has npm, from wherever, keeps it.
view:
	scripts/setup.sh packages.txt packages-view.txt
	command -v npm >/dev/null || scripts/setup.sh packages-page.txt
	$(product)
	cmake -B build/release -DBERTH_VIEW=ON
	cmake --build --preset release --target berth berth_page
	build/release/berth demo --view

# All tests. Those that hold the clock against a limit run apart, one after the other: what runs beside them would fail them.
test: build
	ctest --preset release -LE timing -j2
	ctest --preset release -L timing -j1

build: setup
	cmake --preset release
	cmake --build --preset release

# BERTH_DATA: a folder with recordings to measure as well, here and below. BENCH_OPTIONS: of berth_bench, such as --quick.
recordings = $(addprefix --scene ,$(wildcard $(BERTH_DATA)/recordings/*/scene.yaml))
bench:
	scripts/setup.sh packages.txt packages-opengl.txt packages-lab.txt packages-bench.txt
	cmake --preset bench
	cmake --build --preset bench
	build/bench/lab/berth_bench --out build/bench_results $(if $(BERTH_DATA),$(recordings)) $(BENCH_OPTIONS)

# Measures the speeds that README.md and lab/bench/RESULTS.md quote, and writes them there; best where nothing else runs.
figures:
	scripts/setup.sh packages.txt packages-opengl.txt packages-lab.txt packages-bench.txt
	cmake --preset bench
	cmake --build --preset bench --target berth_bench
	lab/bench/figures.py build/bench/lab/berth_bench

# Adds the laboratory to what build/release has.
lab:
	scripts/setup.sh packages.txt packages-opengl.txt packages-lab.txt
	$(product)
	cmake -B build/release -DBERTH_OPENGL=ON -DBERTH_BUILD_LAB=ON

# Writes build/study/index.html. STUDY_OPTIONS: of berth_study, such as --quick. A study that was stopped goes on.
study: lab
	cmake --build --preset release --target berth_study
	build/release/lab/berth_study --out build/study $(if $(BERTH_DATA),$(recordings)) $(STUDY_OPTIONS)

# An arm beside people, its speed scaled by who watches it. CLOSED_LOOP_OPTIONS: of berth_closed_loop, such as --encounters 20.
closed-loop: lab
	cmake --build --preset release --target berth_closed_loop
	mkdir -p build/closed_loop
	build/release/lab/berth_closed_loop --csv build/closed_loop/encounters.csv $(CLOSED_LOOP_OPTIONS)
	build/release/lab/berth_closed_loop --film build/closed_loop --first 2
	lab/closed_loop/film_strip.py build/closed_loop build/closed_loop/film_strip.png

# Both on OpenGL. GL_DEVICE: as for `berth run --gl-device`; results.md is ready for lab/bench/RESULTS.md.
gl_device = $(if $(GL_DEVICE),--gl-device "$(GL_DEVICE)")
bench-gpu:
	scripts/setup.sh packages.txt packages-opengl.txt packages-lab.txt packages-bench.txt
	cmake --preset bench
	cmake --build --preset bench --target berth_bench berth_study
	build/bench/lab/berth_bench --backend opengl $(gl_device) --out build/bench_gpu \
	  $(if $(BERTH_DATA),$(recordings)) $(BENCH_OPTIONS)
	build/bench/lab/berth_study --backend opengl $(gl_device) --out build/bench_gpu/study \
	  $(if $(BERTH_DATA),$(recordings)) $(STUDY_OPTIONS)

# The tests under AddressSanitizer and UBSan, then, with vector code for one lane, under ThreadSanitizer: all, or those that say so.
sanitize: sanitize-asan sanitize-tsan
sanitize-%: setup
	cmake --preset $*
	cmake --build --preset $*
	ctest --preset $* -j2
sanitize-thinned: thinned-asan thinned-tsan
thinned-%: setup
	cmake --preset $*
	cmake --build --preset $* --target $*_thinned
	ctest --preset $* -j2 --label-regex $* --no-tests=error

# Each reader of a file under libFuzzer, for so many seconds each.
FUZZ_SECONDS ?= 300
fuzz:
	scripts/fuzz.sh "$(FUZZ_SECONDS)"

# What `make test` shows thinned, in full; all tables land in build/trust/. TRUST_OPTIONS: of berth_trust, such as --scenes 20.
trust_table = mkdir -p build/trust && build/release/lab/berth_trust $(if $(BERTH_DATA),--robots $(BERTH_DATA)/robots) $(2) $(TRUST_OPTIONS) \
  >build/trust/$(1).md && cat build/trust/$(1).md
trust: trust-distances trust-real-images trust-long-runs trust-streams trust-whole-robot trust-contact trust-sequences
berth_trust: lab
	cmake --build --preset release --target berth_trust
trust-distances: berth_trust
	$(call trust_table,distances)
trust-real-images: berth_trust
ifneq ($(BERTH_DATA),)
	$(call trust_table,real_images,--real-images $(BERTH_DATA)/depth)
else
	@echo "trust-real-images: skipped; BERTH_DATA=FOLDER names the folder with robots/ and depth/"
endif
trust-long-runs: setup
	cmake --preset release
	cmake --build --preset release --target long_run_test
	BERTH_LONG_RUN=full build/release/tests/pipeline/long_run_test
trust-streams: setup
	cmake --preset release
	cmake --build --preset release --target stream_test
	BERTH_STREAMS=full build/release/tests/distance/stream_test
trust-whole-robot: setup
	cmake --preset release
	cmake --build --preset release --target berth_trust mesh_distances_test
	BERTH_MESH_TWIN=full build/release/tests/truth/mesh_distances_test
	$(call trust_table,whole_robot,--whole-robot)
trust-contact: berth_trust
	$(call trust_table,contact,--contact)
trust-sequences: lab
	cmake --build --preset release --target measure_sequences
	mkdir -p build/trust && build/release/lab/measure_sequences >build/trust/sequences.md && cat build/trust/sequences.md

# Adds the Python module to what build/release has: build/release/python/berth.
python:
	scripts/setup.sh packages.txt packages-python.txt
	$(product)
	cmake -B build/release -DBERTH_PYTHON=ON
	cmake --build --preset release --target berth_python

# The ROS 2 packages and their tests, in a ROS 2 that is sourced.
test-ros2:
	scripts/test_ros2.sh

# All that the tests need.
setup:
	scripts/setup.sh packages.txt packages-opengl.txt packages-lab.txt packages-python.txt packages-view.txt packages-tests.txt

# Runs the tests that docs/evidence.md names: build/evidence.md has their outcomes, the commit and the machine.
evidence: build
	scripts/evidence.py build/release

# The API's pages: build/docs/html/index.html.
docs:
	scripts/setup.sh packages.txt packages-docs.txt
	scripts/docs.sh

# All pages and the API's, with search: build/site/index.html.
site: python
	scripts/setup.sh packages-docs.txt packages-site.txt
	scripts/site.sh

# Checks versions, changelog and what was promised, then makes all that a release has: build/release_files.
release:
	scripts/release.sh

# Debian packages, built, linted and tried in bare systems: build/deb. SUITE=trixie: of Debian 13.
SUITE ?= bookworm
deb:
	scripts/deb.sh $(SUITE)

# The Python wheel with its libraries inside: build/wheel.
wheel:
	scripts/wheel.sh

# All tests in a bare Debian 13.
test-debian13:
	scripts/bare.sh trixie 'apt-get install -qq --no-install-recommends make; make test'

# Cross-built for ARM64 in a bare Debian 12; the tests run in qemu, with a tenth of the random cases, all but those that hold the clock against a limit: hours.
# TEST_OPTIONS: of ctest, such as "-R ^Robot".
test-arm64:
	scripts/bare.sh bookworm 'scripts/test_arm64.sh $(TEST_OPTIONS)'

# The repositories that bloom releases ROS packages from: build/ros_release.
ros-release:
	scripts/ros_release.sh

# clang-tidy over src and apps. PART: a part of the paths, such as src/berth/robot.
lint:
	scripts/setup.sh packages.txt packages-opengl.txt packages-view.txt packages-lint.txt
	cmake --preset lint
	cmake --build --preset lint --target berth_shader_texts
	scripts/lint.sh "$(PART)"

format:
	git ls-files '*.hpp' '*.cpp' | xargs clang-format -i

clean:
	rm -rf build
