#include "granum/map/run_deposits.hpp"

#include "granum/base/error.hpp"
#include "granum/io/events_file.hpp"
#include "granum/io/summary_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace granum::map
{
namespace
{
//! Means of log10 of the drying time, one per interval in which anything has dried.
Window window_of(std::vector<double> const& time, std::vector<double> const& solids, std::vector<double> const& drying,
                 double interval)
{
    auto const [first, last] = std::minmax_element(time.begin(), time.end());
    Window out{.from = *first, .to = *last, .interval = interval};
    auto const count = static_cast<std::size_t>((*last - *first) / interval);
    std::vector<double> weight(count), sum(count);
    for (std::size_t row = 0; row < time.size(); ++row) {
        auto const at = static_cast<std::size_t>((time[row] - *first) / interval);
        if (at >= count || !(drying[row] > 0)) continue;
        weight[at] += solids[row], sum[at] += solids[row] * std::log10(drying[row]);
    }
    std::vector<double> means, begins;
    for (std::size_t k = 0; k < count; ++k)
        if (weight[k] > 0)
            means.push_back(sum[k] / weight[k]), begins.push_back(*first + static_cast<double>(k) * interval);
    auto const steady = math::steady_part(means);
    if (!means.empty()) out.from = begins[steady.start];
    out.settled = steady.settled, out.mean = steady.mean, out.error = steady.error;
    return out;
}
}

std::vector<std::string> const& event_variables()
{
    static std::vector<std::string> const all{
        "drying_time", "moisture_at_impact",    "droplet_diameter", "normal_speed",
        "weber",       "gas_temperature",       "drying_potential", "granule_temperature",
        "coverage",    "solids_fraction",       "mean_flux",        "max_flux",
        "footprint",   "mean_drying_potential", "wet_contacts",     "viscous_stokes"};
    return all;
}

RunDeposits read_deposits(std::string const& folder, double interval)
{
    namespace fs = std::filesystem;
    RunDeposits out;
    out.folder = folder;
    auto const table = io::read_events((fs::path(folder) / "events.h5").string());
    auto const summary = io::read_summary(folder);
    out.title = summary.value("title", fs::path(folder).filename().string());
    auto const measured = io::number_at(summary, "result.eta_global");
    out.potential = measured ? *measured : io::number_at(summary, "balance.eta").value_or(std::nan(""));

    auto const column = [&](std::string const& name) -> std::vector<double> const& {
        auto const* found = table.find(name);
        if (!found) throw base::IoError(fmt::format("{}/events.h5: has no column {}", folder, name));
        return *found;
    };
    auto const &solids = column("solids"), &ended = column("t_dry_end"), &initial = column("initial"),
               &drying = column("drying_time"), &granule = column("granule");
    double const settled = io::number_at(summary, "start.settled_s").value_or(0);
    std::vector<double> times, masses, dryings;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const mass = solids[row] * (1 - initial[row]);
        if (mass <= 0 || ended[row] < settled) continue;
        rows.push_back(row);
        times.push_back(ended[row]), masses.push_back(mass), dryings.push_back(drying[row]);
    }
    base::require(!rows.empty(), "{}: no deposit of the spray has dried{}", folder,
                  settled > 0 ? fmt::format(" after the {:.3g} s in which the bed settled", settled) : "");
    out.window = window_of(times, masses, dryings, interval);
    auto const& start = io::at(summary, "start");
    if (start.contains("settled_s") && start["settled_s"].is_null()) out.window.settled = false;

    auto& deposits = out.deposits;
    std::vector<std::vector<double> const*> columns;
    // A run of an older version may lack some; who asks for such a one is told.
    for (auto const& name : event_variables())
        if (auto const* found = table.find(name)) deposits.names.push_back(name), columns.push_back(found);
    deposits.values.resize(deposits.names.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (times[k] < out.window.from) continue;
        deposits.time.push_back(times[k]);
        deposits.solids.push_back(masses[k]);
        deposits.granule.push_back(granule[rows[k]]);
        for (std::size_t v = 0; v < columns.size(); ++v) deposits.values[v].push_back((*columns[v])[rows[k]]);
    }
    return out;
}
}
