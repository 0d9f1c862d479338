// What the files of a run held at a checkpoint, and how they go on from there.
#include "granum/sim/output.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cstring>

namespace granum::sim
{
namespace
{
std::vector<char> letters(std::string const& text)
{
    return {text.begin(), text.end()};
}
std::string text_of(io::Section const& section)
{
    auto const chars = io::values_of<char>(section);
    return {chars.begin(), chars.end()};
}

constexpr char const* layout = "output.layout";

//! Of what a checkpoint holds as plain records.
std::vector<std::uint64_t> record_sizes()
{
    return {sizeof(Sample), sizeof(product::LayerSum), sizeof(drying::Deposit), sizeof(drying::Event),
            sizeof(spray::Droplet)};
}
}

void Output::check(io::Sections const& saved)
{
    auto const found = std::find_if(saved.begin(), saved.end(), [](auto const& one) { return one.name == layout; });
    if (found == saved.end() || io::values_of<std::uint64_t>(*found) != record_sizes())
        throw base::IoError(
            "the run was begun by another version of Granum, whose records are others: go on with that "
            "one, or begin anew with --fresh");
}

io::Sections Output::save() const
{
    if (!root_) return {};
    io::Sections out{io::section_of(layout, record_sizes()),
                     io::section_of("output.samples", samples_),
                     io::section_of("output.layers", layers_),
                     io::section_of("output.counts", std::vector<long>{event_count_, pictures_}),
                     io::section_of("output.granules", letters(granules_.entries())),
                     io::section_of("output.droplets", letters(droplets_.entries())),
                     io::section_of("output.gas", letters(gas_.entries()))};
    walls_.save(out);
    boxes_.save(out);
    probes_.save(out);
    if (event_log_) out.push_back(io::section_of("output.events", std::vector<io::RowLog::Mark>{event_log_->mark()}));
    return out;
}

void Output::go_on(io::Sections const& saved)
{
    auto const find = [&](char const* name) -> io::Section const& { return io::find_section(saved, name); };
    samples_ = io::values_of<Sample>(find("output.samples"));
    for (auto const& sample : samples_) write(sample);
    layers_ = io::values_of<product::LayerSum>(find("output.layers"));
    auto const counts = io::values_of<long>(find("output.counts"));
    event_count_ = counts.at(0), pictures_ = static_cast<int>(counts.at(1));
    granules_.go_on(text_of(find("output.granules")));
    droplets_.go_on(text_of(find("output.droplets")));
    gas_.go_on(text_of(find("output.gas")));
    walls_.go_on(saved);
    boxes_.go_on(saved);
    probes_.go_on(saved);
    if (event_log_) {
        event_log_->go_on(io::values_of<io::RowLog::Mark>(find("output.events")).at(0),
                          [&](std::span<double const> row) {
                              events_->append(row);
                              drying::Event event;
                              std::memcpy(&event, row.data(), sizeof event);
                              surfaces_.take(event, simulation_.data().spray.solids_density);
                          });
        events_->flush();
    }
}
}
