// How the page of a calibration looks: light and dark, from a tablet's width on.
#pragma once

namespace berth::app {

inline constexpr const char* kCalibrationPageStyle = R"(
:root { color-scheme: light dark; --paper: #f4f5f7; --card: #fff; --ink: #1b1f24; --faint: #5b6570;
  --line: #d5d9de; --after: #2b74be; --before: #c95400; --warn: #fff3d6; --warn-line: #d99a00; }
@media (prefers-color-scheme: dark) { :root { --paper: #15181d; --card: #1e2329; --ink: #eceef1;
  --faint: #a3abb5; --line: #3a424b; --after: #6fb1ec; --before: #f59a4a; --warn: #3a2f14; --warn-line: #d99a00; } }
* { box-sizing: border-box; }
body { margin: 0; padding: 1.5rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 76rem; margin: 0 auto; }
h1 { font-size: 1.5rem; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 0; overflow-wrap: anywhere; }
h3 { font-size: 1rem; margin: 1.75rem 0 .5rem; }
p { margin: .25rem 0 .75rem; max-width: 60rem; }
ul { margin: .25rem 0; padding-left: 1.25rem; max-width: 60rem; }
li { margin: .25rem 0; }
section { background: var(--card); border: 1px solid var(--line); border-radius: .6rem;
  padding: 1.25rem 1.5rem; margin: 1.25rem 0; }
.lead { font-size: 1.15rem; font-weight: 600; }
.faint { color: var(--faint); font-size: .9rem; }
.warning, .refused { background: var(--warn); border-left: .3rem solid var(--warn-line);
  border-radius: .3rem; padding: .6rem 1rem; margin: .75rem 0; max-width: none; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(19rem, 1fr)); gap: 0 2.5rem; align-items: start; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: .3rem .75rem; border-bottom: 1px solid var(--line); vertical-align: top; }
th { font-weight: 600; }
th:first-child, td:first-child { text-align: left; padding-left: 0; font-weight: normal; }
td.text, th.text { text-align: left; }
td.value { white-space: nowrap; font-weight: 600; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .92em; }
figure { margin: 0; }
figcaption { color: var(--faint); font-size: .9rem; margin-top: .25rem; }
.frame { display: grid; grid-template-columns: 1fr 1fr; gap: .75rem; margin: .25rem 0 1.25rem; }
.frame img { display: block; width: 100%; max-height: 48rem; object-fit: contain; background: #15181d; border-radius: .3rem; }
.frame .none { background: var(--paper); border-radius: .3rem; padding: 1rem; }
@media (max-width: 40rem) { body { padding: .5rem; } section { padding: 1rem; } .frame { grid-template-columns: 1fr; }
  .settings tr { display: grid; grid-template-columns: 1fr auto; } .settings td.text { grid-column: 1 / 3; padding-left: 0; } .settings td:not(.text) { border: 0; } }
svg { display: block; width: 100%; height: auto; max-width: 36rem; }
svg .after { fill: var(--after); fill-opacity: .45; stroke: var(--after); stroke-width: 1.5; }
svg .before { fill: none; stroke: var(--before); stroke-width: 2; }
svg .axis, svg .zero { fill: none; stroke: var(--faint); stroke-width: 1; }
svg .zero { stroke-dasharray: 3 4; }
svg .label { fill: var(--faint); font-size: 13px; }
.key { display: inline-block; width: 1.1em; height: .8em; margin: 0 .35em 0 0; border-radius: .15em; vertical-align: baseline; }
.key.before { background: none; border: 2px solid var(--before); }
.key.after { background: var(--after); }
.keys span { display: inline-block; margin-right: 1.25rem; }
.slices { display: grid; grid-template-columns: repeat(auto-fill, minmax(8.5rem, 1fr)); gap: .75rem; margin: .75rem 0; }
.scale { max-width: 36rem; margin: .5rem 0; }
.scale .bar { height: 1rem; border-radius: .2rem; border: 1px solid var(--line); }
.scale .ticks { display: flex; justify-content: space-between; font-size: .85rem; color: var(--faint); font-variant-numeric: tabular-nums; }
.scale .ticks span { flex: 1 1 0; text-align: center; }
)";

}  // namespace berth::app
