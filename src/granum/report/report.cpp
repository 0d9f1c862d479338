#include "granum/report/report.hpp"

#include "granum/io/text_file.hpp"
#include "granum/report/page.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace granum::report
{
std::string write(std::string const& run_folder)
{
    RunFolder const run = read_run(run_folder);
    std::string page;
    page += verdict_section(run) + pictures_section(run);
    if (run.granules_alone())
        page += packing_section(run) + curves_section(run);
    else
        page += porosity_section(run) + product_section(run) + checks_section(run) + curves_section(run) +
                probes_section(run) + events_section(run) + spray_section(run);
    page += performance_section(run) + warnings_section(run) + case_section(run);
    page +=
        "<footer>Made by Granum from the files beside this page: summary.json, timeseries.csv, events.h5, and a series "
        "for "
        "ParaView.</footer>\n";
    std::string const path = std::filesystem::path(run_folder) / "report.html";
    io::replace_text(path,
                     whole_page(run.text("title", run.text("case.title", "Untitled case")) + " – Granum report", page));
    return path;
}
}
