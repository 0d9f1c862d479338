#include "granum/sim/summary.hpp"

#include "granum/sim/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace granum::sim
{
using json = nlohmann::json;

namespace
{
//! Mean of a reading over the samples from `from` on.
template <class Pick>
double mean(std::vector<Sample> const& samples, double from, Pick&& pick)
{
    double sum = 0;
    int count = 0;
    for (auto const& sample : samples)
        if (sample.time >= from) sum += pick(sample), ++count;
    return count > 0 ? sum / count : 0;
}

json ledger(Ledger const& l)
{
    return {{"relative_error", l.relative_error()},
            {"bar", l.bar},
            {"start", l.start},
            {"in", l.in},
            {"out", l.out},
            {"now", l.now},
            {"unit", l.unit}};
}

json packing_part(BedStatistics const& bed, Case const& data, std::vector<BoxContent> const& boxes)
{
    json out{{"coordination_number", bed.coordination},
             {"share_with_neighbours", bed.neighbours},
             {"contacts", bed.contacts},
             {"wall_contacts", bed.wall_contacts},
             {"overlap",
              {{"mean", bed.overlap_mean},
               {"p99", bed.overlap_p99},
               {"largest", bed.overlap_largest},
               {"criterion", data.output.overlap_criterion},
               {"share_beyond", bed.overlap_beyond}}},
             {"wall_force_N", {bed.wall_force.x, bed.wall_force.y, bed.wall_force.z}}};
    for (std::size_t k = 0; k < boxes.size(); ++k)
        out["boxes"][data.output.boxes[k].name] = {{"solids_fraction", boxes[k].solids_fraction},
                                                   {"granules", boxes[k].granules}};
    return out;
}

json product_part(Simulation const& simulation, Output const& output)
{
    auto const& data = simulation.data();
    json out{{"model", data.product.porosity_model},
             {"validated", false},
             {"illustrative", data.product.illustrative},
             {"notice", "this map is not validated on a measured product"}};
    auto const& view = output.last_view();
    if (!view.diameter.empty()) {
        auto const sizes = product::size_percentiles(view.diameter, view.count, product::Weighting::volume);
        out["size_m"] = {{"d10", sizes.p10}, {"d50", sizes.p50}, {"d90", sizes.p90}};
    }
    if (!output.samples().empty()) out["residual_moisture"] = output.samples().back().readings.bed_moisture;
    if (output.event_count() == 0) {
        out["porosity"] = nullptr;
        return out;
    }
    if (auto const surface = output.surfaces().statistics(); surface.granules > 0)
        out["surface"] = {{"granules", surface.granules},
                          {"coverage", surface.coverage},
                          {"uncovered", 1 - surface.coverage},
                          {"thickness_m", surface.mean_thickness},
                          {"variation_within", surface.variation_within},
                          {"variation_between", surface.variation_between}};
    auto const batch = product::batch_property(output.layers());
    out["porosity"] = {{"mean", batch.mean.mean},
                       {"p10", batch.granules.p10},
                       {"p50", batch.granules.p50},
                       {"p90", batch.granules.p90},
                       {"interval_low", batch.low},
                       {"interval_high", batch.high},
                       {"deviation_common", batch.mean.common},
                       {"deviation_sampling", batch.mean.element}};
    return out;
}
}

std::string summary(Simulation& simulation, Output const& output, Performance const& performance,
                    std::vector<std::string> const& warnings, std::string const& ended)
{
    auto const& data = simulation.data();
    auto const& samples = output.samples();
    Sample const last = samples.empty() ? Sample{} : samples.back();
    double const end = last.time, settled = simulation.settling().end;
    // Not of the time in which the bed settled, unless there is none besides.
    double const third = settled < end ? std::max(2 * end / 3, settled) : 2 * end / 3;
    auto const over_last_third = [&](auto pick) { return mean(samples, third, pick); };
    json out;
    out["schema"] = "granum-summary-1";
    out["title"] = data.title;
    out["ended"] = ended;
    out["warnings"] = warnings;
    out["run"] = {{"wall_s", performance.wall},
                  {"simulated_s", simulation.time()},
                  {"steps", simulation.steps()},
                  {"ranks", simulation.comm().size()},
                  {"granule_step_s", simulation.granule_dt()}};
    out["state_hash"] = performance.state_hash;
    double represented = 0;
    for (double c : output.last_view().count) represented += c;
    out["granules"] = {{"parcels", data.granules.parcels},
                       {"represented", represented},
                       {"mass_kg", data.granules.mass},
                       {"parcel_ratio", data.granules.parcel_ratio}};
    if (data.start.settling > 0) {
        auto const& settling = simulation.settling();
        out["start"] = {{"settled_s", settling.end < 0 ? json() : json(settling.end)}, {"settled", settling.enough}};
    }
    out["packing"] = packing_part(last.bed, data, output.boxes());
    if (auto const* hard = simulation.mover().hard_watch())
        out["collisions"] = {{"pairs", hard->collisions},
                             {"walls", hard->wall_collisions},
                             {"kept_elastic", hard->kept_elastic},
                             {"time_driven_s", hard->time_driven},
                             {"time_driven_steps", hard->time_driven_steps},
                             {"held_back", hard->held_back}};
    out["mechanics"] = {{"kinetic_J", last.bed.translation},   {"rotation_J", last.bed.rotation},
                        {"potential_J", last.bed.potential},   {"elastic_J", last.bed.elastic},
                        {"dissipated_J", last.bed.dissipated}, {"wall_work_J", last.bed.wall_work}};
    if (!simulation.has_gas()) {
        out["mechanics"]["residual_J"] = output.energy_residual();
        out["mechanics"]["relative_error"] =
            output.energy_passed() > 0 ? output.energy_residual() / output.energy_passed() : 0;
    }
    if (!data.feeds.empty() || last.traffic.left > 0)
        out["traffic"] = {{"fed_kg", last.traffic.fed_mass},
                          {"fed_parcels", last.traffic.fed},
                          {"discharged_kg", last.traffic.left_mass},
                          {"discharged_parcels", last.traffic.left}};
    if (auto probes = output.probes().summary(third); !probes.is_null()) out["probes"] = std::move(probes);
    if (simulation.has_gas()) {
        auto const& steady = simulation.steady();
        out["gas"]["cells"] = data.gas.cells[0] * data.gas.cells[1] * data.gas.cells[2];
        if (steady.dry_mass_flow > 0)
            out["balance"] = {{"eta", steady.eta},
                              {"outlet_humidity", steady.outlet_humidity},
                              {"outlet_temperature_K", steady.outlet_temperature},
                              {"wet_bulb_K", steady.wet_bulb},
                              {"wet_bulb_humidity", steady.wet_bulb_humidity},
                              {"outlet_relative_humidity", steady.outlet_relative_humidity}};
        out["result"] = {
            {"eta_global", over_last_third([](Sample const& s) { return s.readings.eta; })},
            {"outlet_humidity", over_last_third([](Sample const& s) { return s.readings.outlet_humidity; })},
            {"outlet_temperature_K", over_last_third([](Sample const& s) { return s.readings.outlet_temperature; })},
            {"bed_temperature_K", over_last_third([](Sample const& s) { return s.readings.bed_temperature; })}};
        double coldest = 1e9, hottest = 0;
        for (auto const& s : samples) {
            coldest = std::min(coldest, s.readings.coldest);
            hottest = std::max(hottest, s.readings.hottest);
        }
        out["result"]["coldest_K"] = coldest, out["result"]["hottest_K"] = hottest;
        // The bed swings with its bubbles: its means take twice the time of the others.
        auto const over_two_thirds = [&](auto pick) { return mean(samples, end / 3, pick); };
        out["bed"] = {
            {"pressure_drop_Pa", over_two_thirds([](Sample const& s) { return s.readings.pressure_drop; })},
            {"weight_over_area_Pa", over_two_thirds([](Sample const& s) { return s.readings.weight_over_area; })},
            {"height_m", over_two_thirds([](Sample const& s) { return s.readings.height; })}};
    }
    if (data.spray.present) {
        auto const& t = last.totals;
        out["spray"] = {{"sprayed_kg", t.solids},    {"deposited_kg", t.deposited}, {"overspray_kg", t.overspray},
                        {"on_walls_kg", t.walls},    {"in_flight_kg", t.in_flight}, {"hits", t.hits},
                        {"splashed_kg", t.splashed}, {"abraded_kg", t.abraded},     {"rebounds", t.rebounds}};
        out["water"] = {{"sprayed_kg", t.water},
                        {"evaporated_kg", t.evaporated},
                        {"on_granules_kg", last.readings.water_on_granules}};
        auto const first =
            std::find_if(samples.begin(), samples.end(), [&](auto const& s) { return s.time >= end / 3; });
        if (first != samples.end() && end > 0) {
            out["water"]["sprayed_last_two_thirds_kg"] = t.water - first->totals.water;
            out["water"]["evaporated_last_two_thirds_kg"] = t.evaporated - first->totals.evaporated;
        }
    }
    if (simulation.has_gas()) {
        auto const& heat = performance.heat;
        out["heat"] = {{"between_granules_by_contact_J", heat.contacts},
                       {"between_granules_by_gas_J", heat.film},
                       {"granules_to_walls_by_contact_J", heat.wall_contacts},
                       {"granules_to_walls_by_gas_J", heat.wall_film},
                       {"gas_to_walls_J", heat.wall_gas},
                       {"radiated_by_granules_J", heat.radiation},
                       {"to_settle_the_bed_J", heat.settling}};
    }
    auto const& ledgers = simulation.ledgers();
    out["ledger"] = {{"solids", ledger(ledgers.solids)},
                     {"water", ledger(ledgers.water)},
                     {"energy", ledger(ledgers.energy)},
                     {"momentum", {{"relative_error", ledgers.momentum}, {"bar", Ledgers::momentum_bar}}}};
    out["events"]["count"] = output.event_count();
    out["product"] = product_part(simulation, output);
    double total = 0;
    for (double s : performance.seconds) total += s;
    out["performance"]["granule_steps_per_s"] =
        performance.wall > 0 ? static_cast<double>(performance.granule_steps) / performance.wall : 0;
    if (double const parcels = static_cast<double>(simulation.data().granules.parcels);
        parcels > 0 && performance.lists > 0)
        out["performance"]["steps_per_list"] =
            static_cast<double>(performance.granule_steps) / parcels / static_cast<double>(performance.lists);
    for (std::size_t s = 0; s < performance.seconds.size(); ++s)
        out["performance"]["share"][std::string(base::stage_names[s])] = total > 0 ? performance.seconds[s] / total : 0;
    for (std::size_t s = 0; s < performance.seconds.size(); ++s)
        out["performance"]["seconds"][std::string(base::stage_names[s])] = performance.seconds[s];
    if (auto const& gas = performance.gas; gas.cell_steps > 0) {
        double const seconds = performance.seconds[static_cast<std::size_t>(base::Stage::gas)];
        out["performance"]["gas"] = {{"us_per_cell_step", 1e6 * seconds / gas.cell_steps},
                                     {"pressure_iterations", gas.iterations / gas.cell_steps},
                                     {"sweeps", gas.sweeps / gas.cell_steps},
                                     {"bytes_per_cell_step", gas.bytes / gas.cell_steps},
                                     {"bytes_per_s", gas.bytes / seconds}};
        if (performance.triad_rate > 0) {
            out["performance"]["gas"]["triad_bytes_per_s"] = performance.triad_rate;
            out["performance"]["gas"]["share_of_bandwidth"] = gas.bytes / seconds / performance.triad_rate;
        }
    }
    return out.dump(2);
}

std::string closing_words(std::string const& summary_json)
{
    json const s = json::parse(summary_json);
    std::string out =
        fmt::format("{} after {:.3g} s of process in {:.0f} s of work on {} rank{}\n", s["ended"].get<std::string>(),
                    s["run"]["simulated_s"].get<double>(), s["run"]["wall_s"].get<double>(),
                    s["run"]["ranks"].get<int>(), s["run"]["ranks"] == 1 ? "" : "s");
    auto const& product = s["product"];
    if (product["porosity"].is_object()) {
        auto const& p = product["porosity"];
        out += fmt::format(
            "layer porosity    {:.3f} (95 % interval {:.3f} to {:.3f}); by layer p10 {:.3f}, p50 {:.3f}, p90 {:.3f}\n",
            p["mean"].get<double>(), p["interval_low"].get<double>(), p["interval_high"].get<double>(),
            p["p10"].get<double>(), p["p50"].get<double>(), p["p90"].get<double>());
        out += fmt::format("                  {}\n", product["notice"].get<std::string>());
    }
    if (!s.contains("gas") && s.contains("packing")) {
        auto const& overlap = s["packing"]["overlap"];
        if (s.contains("collisions")) {
            auto const& met = s["collisions"];
            out += fmt::format("collisions        {} of granules, {} with walls; largest overlap {:.1e} of a radius",
                               met["pairs"].get<long>(), met["walls"].get<long>(), overlap["largest"].get<double>());
            if (met["time_driven_s"].get<double>() > 0)
                out += fmt::format("; {:.3g} s in time-driven steps", met["time_driven_s"].get<double>());
            out += "\n";
        } else
            out += fmt::format(
                "packing           coordination {:.2f}; overlaps mean {:.2g} %, 99 % below {:.2g} %, largest {:.2g} "
                "%\n",
                s["packing"]["coordination_number"].get<double>(), 100 * overlap["mean"].get<double>(),
                100 * overlap["p99"].get<double>(), 100 * overlap["largest"].get<double>());
        auto const& energy = s["mechanics"];
        out += fmt::format("energy            moving {:.3g} J, dissipated {:.3g} J",
                           energy["kinetic_J"].get<double>() + energy["rotation_J"].get<double>(),
                           energy["dissipated_J"].get<double>());
        if (energy.contains("relative_error"))
            out += fmt::format(", missing {:.1e} of what moved or was lost", energy["relative_error"].get<double>());
        out += "\n";
        if (s.contains("traffic"))
            out += fmt::format("granules          fed {:.4g} kg, discharged {:.4g} kg\n",
                               s["traffic"]["fed_kg"].get<double>(), s["traffic"]["discharged_kg"].get<double>());
        return out;
    }
    auto const known = [](json const& part, std::initializer_list<char const*> keys) {
        return std::all_of(keys.begin(), keys.end(), [&](char const* key) { return part[key].is_number(); });
    };
    if (s.contains("balance") && known(s["result"], {"eta_global", "outlet_humidity", "outlet_temperature_K"}))
        out += fmt::format(
            "drying potential  {:.4f} (balance {:.4f}); outlet {:.2f} g/kg (balance {:.2f}), {:.1f} degC (balance "
            "{:.1f})\n",
            s["result"]["eta_global"].get<double>(), s["balance"]["eta"].get<double>(),
            1e3 * s["result"]["outlet_humidity"].get<double>(), 1e3 * s["balance"]["outlet_humidity"].get<double>(),
            s["result"]["outlet_temperature_K"].get<double>() - 273.15,
            s["balance"]["outlet_temperature_K"].get<double>() - 273.15);
    if (s.contains("bed") && known(s["bed"], {"pressure_drop_Pa", "weight_over_area_Pa"}))
        out += fmt::format("bed               pressure drop {:.1f} Pa, weight over area {:.1f} Pa\n",
                           s["bed"]["pressure_drop_Pa"].get<double>(), s["bed"]["weight_over_area_Pa"].get<double>());
    out += fmt::format(
        "ledgers           solids {:.1e}, water {:.1e}, energy {:.1e}, momentum {:.1e} (relative)\n",
        s["ledger"]["solids"]["relative_error"].get<double>(), s["ledger"]["water"]["relative_error"].get<double>(),
        s["ledger"]["energy"]["relative_error"].get<double>(), s["ledger"]["momentum"]["relative_error"].get<double>());
    return out;
}
}
