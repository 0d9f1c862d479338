// Reads [time] and [output]: how long a run is, its steps, and what it writes down.
#include "granum/sim/case_sections.hpp"

#include <set>

namespace granum::sim
{
using io::Dimension;

void read_time(io::CaseFile& file, Case& data, Purpose purpose)
{
    TimeCase& time = data.time;
    bool const whole = purpose == Purpose::run;
    time.duration = file.quantity("time.duration", Dimension::time, whole ? std::nullopt : std::optional(time.duration),
                                  "to be simulated", io::positive);
    time.granule_step =
        file.optional_quantity("time.granule_step", Dimension::time, "otherwise from the bounds", io::positive);
    time.gas_step = file.optional_quantity("time.gas_step", Dimension::time, "otherwise from the bounds", io::positive);
    time.output_interval = file.quantity("output.interval", Dimension::time, time.output_interval,
                                         "of pictures and ParaView files", io::positive);
    time.series_interval = file.quantity("output.series_interval", Dimension::time, time.series_interval,
                                         "of timeseries.csv", io::positive);
    time.checkpoint_interval =
        file.quantity("output.checkpoint_interval", Dimension::time, time.checkpoint_interval,
                      "wall time between checkpoints; the first comes after 2 min at the latest", io::positive);
    time.checkpoint_every =
        file.optional_quantity("output.checkpoint_every", Dimension::time,
                               "time of process between checkpoints, beside the wall time", io::positive);
}

namespace
{
//! Name of the entry at `key` of a list, which heads columns of `table`: no other of the list has it.
std::string read_own_name(io::CaseFile& file, std::string const& key, std::string const& fallback, char const* table,
                          std::set<std::string>& others)
{
    auto name = file.words(key + "name", fallback, std::string("in ") + table);
    check_column_name(file, key + "name", name);
    if (!others.insert(name).second) file.mistake(key + "name", "is that of another one too");
    return name;
}

void read_boxes(io::CaseFile& file, Case& data)
{
    std::set<std::string> names;
    int const count = file.count("output.box");
    for (int i = 0; i < count; ++i) {
        auto const key = fmt::format("output.box[{}].", i);
        BoxCase box;
        box.name = read_own_name(file, key, fmt::format("box-{}", i), "boxes.csv", names);
        box.region = read_box(file, key, data.chamber, "corner of the box to look into");
        data.output.boxes.push_back(std::move(box));
    }
}

void read_probes(io::CaseFile& file, Case& data)
{
    std::set<std::string> names;
    int const count = file.count("output.probe");
    for (int i = 0; i < count; ++i) {
        auto const key = fmt::format("output.probe[{}].", i);
        ProbeCase probe;
        probe.name = read_own_name(file, key, fmt::format("probe-{}", i), "probes.csv", names);
        bool const line = file.has(key + "from") || file.has(key + "to");
        if (line) {
            probe.from = file.vector(key + "from", Dimension::length, std::nullopt, "where the line begins");
            probe.to = file.vector(key + "to", Dimension::length, std::nullopt, "where the line ends");
            probe.points = file.integer(key + "points", 20, "along the line, both ends among them", 2, 1000);
            if (file.has(key + "position"))
                file.mistake(key + "position", "and a line cannot both be given", {"leave out from and to"});
        } else {
            probe.from = probe.to = file.vector(key + "position", Dimension::length, std::nullopt, "where to look");
            if (file.has(key + "points")) file.mistake(key + "points", "belongs to a line", {"add from and to"});
        }
        data.output.probes.push_back(std::move(probe));
    }
    if (count > 0 && !data.gas.present)
        file.mistake("output.probe[0]", "looks at the gas, and there is none", {"[[output.box]] looks at granules"});
}
}

void read_output(io::CaseFile& file, Case& data)
{
    auto& output = data.output;
    output.overlap_criterion =
        file.quantity("output.overlap_criterion", Dimension::one, output.overlap_criterion,
                      "overlaps above this share of a radius are counted", {.low = 0, .high = 1, .low_allowed = false});
    output.surfaces = file.integer("output.surfaces", output.surfaces,
                                   "real granules whose surfaces are laid cap by cap; 0: none", 0, 100000);
    read_boxes(file, data);
    read_probes(file, data);
}

void check_column_name(io::CaseFile& file, std::string const& key, std::string const& name)
{
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
        file.mistake(key, "cannot head a column of a CSV file", {"leave out commas, quotes and line ends"});
}
}
