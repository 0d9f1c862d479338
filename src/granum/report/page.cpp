#include "granum/report/page.hpp"

#include "granum/report/html.hpp"

#include <fmt/format.h>

namespace granum::report
{
namespace
{
// Nothing may be loaded from anywhere: pictures are inside the page, and there is no script.
constexpr char const* policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";

constexpr char const* style = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1180px; padding: 28px 32px 60px; background: #fff; color: #1d2329;
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", "Liberation Sans", Arial, sans-serif; }
h1 { font-size: 30px; line-height: 1.2; margin: 2px 0 6px; overflow-wrap: anywhere; }
h2 { font-size: 20px; margin: 44px 0 12px; padding-bottom: 5px; border-bottom: 2px solid #1b5e8c; }
p { margin: 8px 0; max-width: 75em; }
.brand { color: #1b5e8c; font-weight: 700; letter-spacing: .04em; margin: 0; }
.how { color: #4a545e; margin: 3px 0; }
.statement { font-size: 19px; line-height: 1.4; margin: 18px 0 14px; }
.notice { background: #fff6e0; border: 1px solid #d9a93a; border-left: 7px solid #d9a93a; padding: 10px 14px; max-width: none; }
.tiles { display: grid; grid-template-columns: repeat(6, 1fr); gap: 12px; margin-top: 18px; }
.tile { border: 1px solid #cfd6dc; border-radius: 6px; padding: 10px 12px; display: flex; flex-direction: column; break-inside: avoid; }
.tile .name { color: #4a545e; font-size: 13px; }
.tile .value { font-size: 23px; font-weight: 650; line-height: 1.35; }
.tile .none { color: #4a545e; font-size: 15px; font-weight: 400; padding: 5px 0; }
.tile .note { color: #4a545e; font-size: 12px; }
.pictures { display: grid; grid-template-columns: repeat(3, 1fr); gap: 18px; align-items: start; }
.charts { display: grid; grid-template-columns: repeat(2, 1fr); gap: 18px 28px; align-items: start; }
figure { margin: 0; break-inside: avoid; }
figure.empty, p.empty { border: 1px dashed #aab4bd; border-radius: 6px; padding: 14px; }
figcaption { color: #3a434b; font-size: 13.5px; margin-top: 4px; }
svg.chart, svg.picture { width: 100%; height: auto; display: block; }
svg text { font-size: 12px; fill: #2a3138; }
svg text.strong { font-weight: 600; }
svg .grid { stroke: #e3e7ea; }
svg .axis { stroke: #59636c; }
svg.bar { width: 100%; height: 34px; display: block; }
ul.key { list-style: none; margin: 8px 0 0; padding: 0; display: flex; flex-wrap: wrap; gap: 4px 22px; font-size: 14px; }
ul.key svg { width: 12px; height: 12px; margin-right: 6px; vertical-align: -1px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; break-inside: avoid; }
table.narrow { width: auto; min-width: 380px; margin-top: 12px; }
th { text-align: left; color: #4a545e; font-weight: 600; border-bottom: 1px solid #9aa5ad; padding: 5px 14px 5px 0; }
td { border-bottom: 1px solid #e3e7ea; padding: 5px 14px 5px 0; vertical-align: top; }
.num { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
tr.sum td { font-weight: 600; border-top: 1px solid #9aa5ad; }
th.num { white-space: normal; vertical-align: bottom; }
.name { white-space: nowrap; }
.light { white-space: nowrap; font-weight: 600; }
.light::before { content: ""; display: inline-block; width: 12px; height: 12px; border-radius: 50%; margin-right: 7px; vertical-align: -1px; border: 1px solid #333; }
.good::before { background: #3a9a4a; }
.watch::before { background: #f0b429; }
.bad::before { background: #cc3322; }
.unknown::before { background: #fff; }
summary { cursor: pointer; }
pre { background: #f5f7f8; border: 1px solid #dfe4e8; padding: 14px; overflow-x: auto; font-size: 12.5px; line-height: 1.45; white-space: pre-wrap; }
footer { margin-top: 50px; color: #4a545e; font-size: 13px; border-top: 1px solid #cfd6dc; padding-top: 10px; }
@media screen and (max-width: 820px) { .tiles { grid-template-columns: repeat(2, 1fr); } .pictures, .charts { grid-template-columns: 1fr; } body { padding: 16px; } }
@media print { body { max-width: none; padding: 0; font-size: 10.5pt; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  h2 { break-after: avoid; margin-top: 24px; } .tile .value { font-size: 15pt; } pre { font-size: 8pt; } }
)";
}

std::string whole_page(std::string const& title, std::string const& body)
{
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
        "http-equiv=\"Content-Security-Policy\" "
        "content=\"{}\">\n<meta name=\"viewport\" "
        "content=\"width=device-width\">\n<title>{}</title>\n<style>{}</style>\n"
        "</head>\n<body>\n{}</body>\n</html>\n",
        policy, escape(title), style, body);
}
}
