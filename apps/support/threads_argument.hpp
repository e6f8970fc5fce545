#pragma once

namespace CLI {
class App;
}

namespace berth::app {

/// Adds --threads, for every command that works on several of them; 0 where it is not given.
void add_threads(CLI::App& command, int& threads);

}  // namespace berth::app
