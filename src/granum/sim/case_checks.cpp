// The mistakes that no single value shows: what does not fit, float, dry or stay stable.
#include "granum/particle/overlaps.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/forecast.hpp"
#include "granum/sim/programme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::sim
{
using io::Dimension;

namespace
{
bool chamber_known(io::CaseFile const& file, Case const& data)
{
    return data.chamber.known() && file.has("apparatus") && !file.wrong("apparatus.shape") &&
           !file.wrong("apparatus.size") && !file.wrong("apparatus.profile");
}

bool granules_known(io::CaseFile const& file, Case const& data)
{
    bool good = data.granules.parcels > 0;
    for (auto const* key : {"diameter", "density", "mass", "parcels", "parcel_ratio", "file"})
        good = good && !file.wrong(std::string("granules.") + key);
    return good && data.granules.diameter > 0 && data.granules.density > 0;
}

void check_bed(io::CaseFile& file, Case const& data)
{
    if (data.granules.mass > 0 && !settled_height(data)) {
        double const volume = data.granules.mass / data.granules.density / 0.6;
        file.mistake("granules.mass",
                     fmt::format("makes a bed taller than the chamber: {:.3g} L at 60 % solids", 1e3 * volume),
                     {fmt::format("the chamber holds {:.3g} L, that is {:.3g} kg", 1e3 * data.chamber.volume(),
                                  data.chamber.volume() * 0.6 * data.granules.density)});
    }
    for (std::size_t i = 0; i < data.granules.given.size(); ++i) {
        auto const key = file.count("granule") > 0 && !file.has("granules.file")
                             ? fmt::format("granule[{}].position", i)
                             : std::string(file.has("granules.run") ? "granules.run" : "granules.file");
        if (data.chamber.inside(data.granules.given[i].position)) continue;
        auto const& x = data.granules.given[i].position;
        file.mistake(key, fmt::format("puts granule {} {}, at ({:.4g}, {:.4g}, {:.4g}) m", i + 1,
                                      where_in_bodies(data.chamber, x), x.x, x.y, x.z));
        break;
    }
}

//! Granules given one by one must not lie deep in each other; shallow overlaps are worth a word.
void check_overlaps(io::CaseFile& file, Case const& data, std::vector<std::string>& warnings)
{
    auto const& given = data.granules.given;
    if (given.size() < 2) return;
    constexpr double bearable = 0.5, noticed = 0.01;  // of a radius: where the engine stops; where contacts burst apart
    std::vector<Vec3> centres;
    std::vector<double> radii;
    for (auto const& one : given) {
        centres.push_back(one.position);
        radii.push_back(0.5 * one.diameter * std::cbrt(one.count));
    }
    auto const found = particle::overlaps(centres, radii);
    if (found.deepest <= noticed) return;
    auto const what = fmt::format("{} pairs of granules overlap, the deepest by {:.3g} % of a radius: {} and {}",
                                  found.pairs, 100 * found.deepest, given[found.first].id, given[found.second].id);
    auto const key = file.has("granules.file")  ? "granules.file"
                     : file.has("granules.run") ? "granules.run"
                                                : "granule";
    if (found.deepest > bearable)
        file.mistake(key, "puts granules into each other: " + what, {"allowed: up to 50 % of a radius, better none"});
    else
        warnings.push_back(fmt::format("{}: {}; they will fly apart", key, what));
}

//! Parcels must be small against cells, and cells against the chamber.
void check_resolution(io::CaseFile& file, Case const& data)
{
    if (!data.gas.present || file.wrong("gas.cells") || file.wrong("gas.cell_size")) return;
    auto const& granules = data.granules;
    double const parcel = granules.diameter * granules.parcel_ratio;
    auto const extent = data.chamber.upper() - data.chamber.lower();
    bool const coarse = granules.parcel_ratio > 1;
    auto const chosen = file.has("granules.parcels") ? "granules.parcels" : "granules.parcel_ratio";
    double across = std::max(extent.x, extent.y);
    if (data.chamber.shape == geometry::Chamber::Shape::revolution)
        for (auto const& point : data.chamber.profile) across = std::min(across, 2 * point.radius);
    if (coarse && across < 3 * parcel) {
        file.mistake(chosen,
                     fmt::format("leaves fewer than 3 cells across: a parcel is {:.3g} mm wide, the chamber {:.3g} mm",
                                 1e3 * parcel, 1e3 * across),
                     {fmt::format("allowed: parcel_ratio up to {:.3g}, that is at least {:.0f} parcels",
                                  across / 3 / granules.diameter,
                                  granules.mass / (granules.density * math::pi / 6 * std::pow(across / 3, 3)))});
        return;
    }
    auto const key = file.has("gas.cell_size") ? "gas.cell_size" : file.has("gas.cells") ? "gas.cells" : "gas";
    if (coarse && std::max(data.gas.cells[0], data.gas.cells[1]) < 3) {
        file.mistake(key, "leaves fewer than 3 cells across the chamber", {"give at least 3 cells along x or y"});
        return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        double const edge = extent[i] / data.gas.cells[i];
        if (edge >= 0.999 * parcel) continue;
        file.mistake(
            key, fmt::format("makes cells of {:.3g} mm, narrower than a parcel of {:.3g} mm", 1e3 * edge, 1e3 * parcel),
            {fmt::format("allowed: up to {:.0f} cells along {}", std::floor(extent[i] / parcel),
                         std::string("xyz")[i])});
        return;
    }
}

void check_steps(io::CaseFile& file, Case const& data)
{
    auto const& time = data.time;
    if (time.granule_step && !data.granules.frozen && !file.wrong("contact.youngs_modulus") &&
        !file.wrong("contact.poisson_ratio") && !file.wrong("contact.stiffness") &&
        !file.wrong("contact.contact_time")) {
        // The recommended bounds keep 0.2 of the Rayleigh time and 20 steps in a contact; integration fails beyond
        // about 1.5 times the first and twice the second.
        // The rolling spring is damped: beyond its bound it is only coarse.
        dem::StepBound wave{std::numeric_limits<double>::infinity(), ""}, contact = wave;
        for (auto const& bound : granule_step_bounds(data, expected_contact_speed(data))) {
            if (bound.reason.starts_with("0.2 of the Rayleigh") && bound.seconds < wave.seconds) wave = bound;
            if (bound.reason.starts_with("1/20") && bound.seconds < contact.seconds) contact = bound;
        }
        double const stable = std::min(1.5 * wave.seconds, 2 * contact.seconds);
        std::vector<std::string> hints{
            fmt::format("allowed: up to {:.3g} s; leave it out to let the program choose", stable)};
        for (auto const* bound : {&wave, &contact})
            if (!bound->reason.empty())
                hints.push_back(fmt::format("bound: {:.3g} s, {}", bound->seconds, bound->reason));
        if (*time.granule_step > stable) file.mistake("time.granule_step", "is above the stable step", hints);
    }
    if (time.gas_step && time.granule_step && *time.gas_step < *time.granule_step)
        file.mistake("time.gas_step", "is shorter than time.granule_step");
}

void check_probes(io::CaseFile& file, Case const& data)
{
    for (std::size_t i = 0; i < data.output.probes.size(); ++i) {
        auto const& probe = data.output.probes[i];
        auto const key = [&](char const* part) { return fmt::format("output.probe[{}].{}", i, part); };
        if (file.wrong(key("position")) || file.wrong(key("from")) || file.wrong(key("to"))) continue;
        for (long k = 0; k < probe.points; ++k) {
            Vec3 const x = probe.at(k);
            if (data.chamber.inside(x)) continue;
            auto const where = where_in_bodies(data.chamber, x);
            if (probe.points < 2)
                file.mistake(key("position"), "is " + where);
            else
                file.mistake(
                    key(k + 1 == probe.points ? "to" : "from"),
                    fmt::format("point {} of the line, ({:.4g}, {:.4g}, {:.4g}) m, is {}", k, x.x, x.y, x.z, where),
                    {"let the line begin and end in the open"});
            break;
        }
    }
}

void check_nozzles(io::CaseFile& file, Case const& data)
{
    bool const repeats = data.periodic[0] || data.periodic[1] || data.periodic[2];
    if (data.spray.present && repeats)
        file.mistake("apparatus.periodic", "does not go with a spray: droplets do not pass periodic sides",
                     {"close the box, or leave out [spray]"});
    for (std::size_t i = 0; i < data.spray.nozzles.size(); ++i) {
        auto const key = fmt::format("nozzle[{}].position", i);
        if (file.wrong(key) || data.chamber.inside(data.spray.nozzles[i].position)) continue;
        auto const& position = data.spray.nozzles[i].position;
        double const z = position.z;
        std::vector<std::string> hints{fmt::format("the chamber is {:.4g} mm high", 1e3 * data.chamber.height())};
        if (data.chamber.region) hints = {"its exit must be in the open, a millimetre or so before its body"};
        if (!data.chamber.region && z > 0 && z < data.chamber.height() &&
            data.chamber.shape == geometry::Chamber::Shape::revolution)
            hints = {fmt::format("at this height the wall is {:.4g} mm from the axis", 1e3 * data.chamber.radius(z))};
        file.mistake(key, "is " + where_in_bodies(data.chamber, position), hints);
    }
}

void check_drying(io::CaseFile& file, Case const& data)
{
    for (auto const* key : {"gas.temperature", "gas.humidity", "gas.relative_humidity", "gas.pressure", "gas.flow",
                            "gas", "spray.rate", "spray.solids_fraction", "spray.temperature"})
        if (file.wrong(key)) return;
    for (auto const& nozzle : data.spray.nozzles)
        if (!std::isfinite(nozzle.air_mass_flow + nozzle.air_temperature + nozzle.air_humidity)) return;
    if (!has_balance(data) || !data.spray.present) return;
    auto const steady = balance(data);
    if (double const melting = data.spray.melting_point; melting > 0 && steady.outlet_temperature >= melting)
        file.mistake(
            "spray.melting_point",
            fmt::format("is not above the temperature that the bed comes to, {:.1f} degC: nothing would solidify",
                        steady.outlet_temperature - math::zero_celsius),
            {"lower gas.temperature or spray.rate, or raise gas.flow"});
    if (data.spray.allow_overwetting || data.spray.melting_point > 0) return;
    for (std::size_t k = 0; k < data.phases.size(); ++k) {
        Case then = data;
        follow(then, Nominal(data), data.phases[k].end);
        if (auto const wet = balance(then); wet.overwetted())
            file.mistake(
                fmt::format("phase[{}]", k),
                fmt::format("has more spray than its air can dry: drying potential {:.2f} at the outlet", wet.eta),
                {"lower spray_rate, raise gas_temperature or gas_share, or set spray.allow_overwetting = true"});
    }
    if (!steady.overwetted()) return;
    double const most =
        (steady.wet_bulb_humidity - steady.inlet_humidity) * steady.dry_mass_flow / (1 - data.spray.solids_fraction);
    file.mistake("spray.rate",
                 fmt::format("is more than the air can dry: drying potential {:.2f} at the outlet", steady.eta),
                 {fmt::format("allowed: up to {:.3g} kg/h with this air (outlet saturated)", 3600 * most),
                  "lower the rate, raise gas.temperature or gas.flow, or set spray.allow_overwetting = true"});
}
}

void cross_check(io::CaseFile& file, Case const& data, Purpose purpose, std::vector<std::string>& warnings)
{
    bool const chamber = chamber_known(file, data);
    bool const by_velocity = std::any_of(data.gas.inlets.begin(), data.gas.inlets.end(),
                                         [](auto const& inlet) { return inlet.velocity > 0; });
    if (purpose == Purpose::balance) {
        if (by_velocity && !chamber)
            file.mistake("gas.velocity", "needs an [apparatus]: the flow depends on its plate");
        return;  // over-wetting is an answer of a balance, not a mistake
    }
    if (chamber) {
        if (granules_known(file, data)) {
            check_bed(file, data);
            if (!data.contact.hard()) check_overlaps(file, data, warnings);
            if (!file.wrong("granules.mass")) check_resolution(file, data);
            if (!data.contact.hard()) check_steps(file, data);
        }
        check_nozzles(file, data);
        check_probes(file, data);
        check_against_bodies(file, data);
    }
    if (!by_velocity || chamber) check_drying(file, data);
    if (chamber) check_hard_spheres(file, data);
    if (file.any_mistake()) return;
    auto const coming = forecast(data, 1);
    warnings.insert(warnings.end(), coming.warnings.begin(), coming.warnings.end());
}
}
