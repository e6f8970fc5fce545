// One reader under libFuzzer: BERTH_READER names it. Bytes are refused by std::exception or they
// are read; what else happens is found here.
#include <algorithm>
#include <cstdlib>
#include <exception>

#include "tests/support/reader_inputs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto readers = berth::reader_inputs();
  const auto reader = std::find_if(readers.begin(), readers.end(),
                                   [](const auto& r) { return r.name == BERTH_READER; });
  if (reader == readers.end()) std::abort();
  try {
    reader->read({data, size});
  } catch (const std::exception&) {
    // Refused, as it should be.
  }
  return 0;
}
