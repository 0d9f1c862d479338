#include "granum/sim/case_reader.hpp"

#include "granum/io/case_file.hpp"
#include "granum/io/data_folder.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/continuation.hpp"

#include <algorithm>
#include <filesystem>

namespace granum::sim
{
std::string take_material(io::CaseFile& file, std::string const& key, std::vector<std::string> const& sections)
{
    auto const folder = std::filesystem::path(io::data_folder()) / "materials";
    std::vector<std::string> known;
    if (std::filesystem::is_directory(folder))
        for (auto const& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".toml") known.push_back(entry.path().stem().string());
    std::sort(known.begin(), known.end());
    if (!file.has(key)) {
        file.know(key);
        return "";
    }
    auto const name =
        file.name(key, std::nullopt, "material whose values stand in for missing ones", known, "a known material");
    if (file.wrong(key)) return "";
    // A real modulus would force steps of nanoseconds: a case states the softened one it wants.
    for (auto const& section : sections)
        file.use_material(section, name, (folder / (name + ".toml")).string(), {"youngs_modulus"});
    return name;
}

ResolvedCase read_case(std::string const& path, Purpose purpose)
{
    using io::Dimension;
    io::CaseFile file(path, home_of(path));
    ResolvedCase out;
    Case& data = out.data;
    data.file = path;
    file.integer("format", 1, "version of the case format", 1, 1);
    data.title = file.words("title", data.title, "for people");
    data.seed = static_cast<std::uint32_t>(file.integer("seed", 1, "of the random numbers", 0, 4294967295L));
    data.gravity = file.vector("gravity", Dimension::acceleration, data.gravity, "acceleration of free fall");
    for (auto const* name :
         {"apparatus", "gas", "granules", "contact", "spray", "drying", "product", "start", "time", "output"})
        file.section(name);

    read_apparatus(file, data, purpose);
    read_contact(file, data);
    read_internals(file, data);
    read_walls(file, data);
    read_region(file, data);
    read_granules(file, data, purpose);
    read_feeds(file, data);
    read_gas(file, data, purpose);
    read_openings(file, data);
    read_gas_walls(file, data);
    read_cells(file, data);
    read_spray(file, data, purpose);
    read_process(file, data);
    read_time(file, data, purpose);
    read_output(file, data);
    read_phases(file, data);  // last: it sets anew what stands above
    cross_check(file, data, purpose, out.warnings);
    file.finish();

    for (auto const& entry : file.provenance())
        out.origins.push_back({entry.key, entry.value, entry.origin, entry.doc});
    out.warnings.insert(out.warnings.end(), file.warnings().begin(), file.warnings().end());
    return out;
}

std::string explain(ResolvedCase const& resolved)
{
    std::size_t wide_key = 0, wide_value = 0;
    for (auto const& entry : resolved.origins) {
        wide_key = std::max(wide_key, entry.key.size());
        wide_value = std::max(wide_value, std::min<std::size_t>(entry.value.size(), 32));
    }
    std::string out;
    for (auto const& entry : resolved.origins)
        out += fmt::format("{:<{}} = {:<{}}  # {}{}{}\n", entry.key, wide_key, entry.value, wide_value, entry.origin,
                           entry.doc.empty() ? "" : ": ", entry.doc);
    return out;
}
}
