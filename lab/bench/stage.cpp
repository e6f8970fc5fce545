#include "lab/bench/stage.hpp"

#include "lab/bench/statistics.hpp"

namespace berth::lab {

Table table_of(const std::string& title, const std::string& note,
               const std::vector<Stage*>& stages) {
  Table table{title, note, "stage", {"median ms", "p99 ms", "max ms"}, {}};
  for (const Stage* stage : stages) {
    table.rows.push_back({stage->name,
                          {median(stage->times_ms), percentile(stage->times_ms, 0.99),
                           percentile(stage->times_ms, 1)},
                          ""});
  }
  return table;
}

}  // namespace berth::lab
