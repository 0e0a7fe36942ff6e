// The look of the report: one column, two colour schemes, no scripts, nothing from outside.
#pragma once

#include <string_view>

namespace illum {

inline constexpr std::string_view kReportStyle = R"css(
:root { color-scheme: light dark;
  --page: #fbfbfa; --text: #1c1d1f; --quiet: #65686d; --line: #dfe0e2; --accent: #b4460f;
  --edge: #00000038; }
@media (prefers-color-scheme: dark) { :root {
  --page: #151618; --text: #e9eaec; --quiet: #9b9fa6; --line: #34363a; --accent: #ff9a5c;
  --edge: #ffffff70; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1080px; padding: 48px 32px 64px; background: var(--page);
  color: var(--text); font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif;
  font-variant-numeric: tabular-nums; }
h1 { margin: 0; font-size: 30px; font-weight: 600; letter-spacing: -0.015em;
  overflow-wrap: anywhere; line-height: 1.2; }
h2 { margin: 56px 0 4px; font-size: 18px; font-weight: 600; }
p { margin: 4px 0; }
.quiet { color: var(--quiet); }
.stats { display: flex; flex-wrap: wrap; gap: 0 40px; margin: 32px 0 0; padding: 20px 0;
  border-top: 1px solid var(--line); border-bottom: 1px solid var(--line); }
.stat { min-width: 120px; padding: 4px 0; }
.stat b { display: block; font-size: 30px; font-weight: 600; line-height: 1.25;
  letter-spacing: -0.015em; }
.stat b small { font-size: 15px; font-weight: 400; letter-spacing: 0; color: var(--quiet); }
.stat span { font-size: 13px; color: var(--quiet); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; margin: 16px 0 0; font-size: 14px; }
th { font-weight: 500; color: var(--quiet); }
th, td { padding: 6px 0 6px 20px; text-align: right; border-bottom: 1px solid var(--line);
  white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
td:first-child { white-space: normal; overflow-wrap: anywhere; }
.lights { display: grid; grid-template-columns: 340px 1fr; gap: 8px 48px; align-items: center;
  margin-top: 16px; }
.lights.both { grid-template-columns: 1fr; }
svg { display: block; width: 100%; height: auto; overflow: visible; }
svg text { fill: var(--quiet); font-size: 12px; }
.dome { margin-bottom: 16px; }
.lights.both .dome { max-width: 680px; }
.ramp { max-width: 240px; margin: 16px 0; }
.key { max-width: 240px; height: 24px; }
.horizon { fill: none; stroke: var(--quiet); }
.grid { fill: none; stroke: var(--line); }
.dot { stroke: var(--edge); stroke-width: 0.75; }
.ring { fill: none; stroke: var(--accent); stroke-width: 1.75; }
.mean { fill: none; stroke: var(--quiet); stroke-width: 1.25; }
.dashed { stroke: var(--accent); stroke-dasharray: 5 4; }
.plot { margin-top: 20px; padding-right: 8px; min-width: 640px; }
.trio { margin: 24px 0 0; display: grid; grid-template-columns: repeat(3, 1fr); gap: 8px 12px; }
.trio header { grid-column: 1 / -1; display: flex; flex-wrap: wrap; gap: 0 20px;
  align-items: baseline; }
.trio header b { font-weight: 600; overflow-wrap: anywhere; }
.tag { color: var(--accent); }
figure { margin: 0; }
figure img { display: block; width: 100%; height: auto; background: #000; }
figcaption { margin-top: 4px; font-size: 13px; color: var(--quiet); }
details { margin-top: 40px; }
summary { cursor: pointer; font-weight: 600; font-size: 18px; }
footer { margin-top: 56px; padding-top: 16px; border-top: 1px solid var(--line); font-size: 13px;
  color: var(--quiet); max-width: 76ch; }
@media (max-width: 720px) { body { padding: 24px 16px 48px; }
  .lights { grid-template-columns: 1fr; } .trio { gap: 4px; } }
@media print { body { max-width: none; padding: 0; } .trio { break-inside: avoid; } }
)css";

}  // namespace illum
