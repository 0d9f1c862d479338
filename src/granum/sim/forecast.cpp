#include "granum/sim/forecast.hpp"

#include "granum/base/error.hpp"
#include "granum/law/drag/all.hpp"
#include "granum/law/drag/fluidisation.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/sim/build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granum::sim
{
namespace
{
constexpr double settled_solids = 0.6;
constexpr double packed_voidage = 0.42;  //!< where minimum fluidisation is evaluated

double parcel_radius(Case const& data)
{
    double radius = std::numeric_limits<double>::infinity();
    for (auto const& kind : granule_kinds(data)) radius = std::min(radius, kind.radius);
    return radius;
}

double gas_density(Case const& data)
{
    auto const& inlet = data.gas.inlet;
    return data.gas.density.value_or(
        material::density(data.gas.pressure, inlet.temperature, material::fraction(inlet.humidity)));
}

//! Effective moduli of two equal granules, Pa.
struct Moduli
{
    double normal, shear;
};
Moduli moduli(MaterialCase const& granule)
{
    double const nu = granule.poisson_ratio, shear = granule.youngs_modulus / (2 * (1 + nu));
    return {granule.youngs_modulus / (2 * (1 - nu * nu)), shear / (2 * (2 - nu))};
}

//! Largest overlap, m, of two equal spheres that meet at `speed` without loss (Hertz, or the linear spring).
double largest_overlap(Case const& data, double radius, double speed)
{
    double const mass = data.granules.density * 4 / 3 * math::pi * radius * radius * radius;
    auto const laws = granule_settings(data).laws;
    if (std::holds_alternative<law::contact::Linear>(laws.normal))
        return speed * std::sqrt(mass / 2 / laws.effective(0, 0).stiffness);
    return std::pow(
        15 * (mass / 2) * speed * speed / (16 * moduli(data.contact.materials.front()).normal * std::sqrt(radius / 2)),
        0.4);
}

constexpr double bytes_per_parcel = 2050;       //!< of granules alone, at the peak: input, state, checkpoint, pictures
constexpr double bytes_of_gas_and_layer = 450;  //!< more with gas: columns, deposits, stencils (assumed)
constexpr double bytes_per_rank = 60e6;         //!< program, libraries

void add_warnings(Case const& data, Forecast& out)
{
    auto const warn = [&out](std::string text) { out.warnings.push_back(std::move(text)); };
    bool const bed = data.granules.mass > 0 && !data.granules.frozen;
    if (bed && out.plate_velocity > 0 && out.plate_velocity < out.minimum_fluidisation)
        warn(fmt::format("the bed is not fluidised: {:.3g} m/s at the plate, {:.3g} m/s needed", out.plate_velocity,
                         out.minimum_fluidisation));
    if (bed && out.plate_velocity > out.terminal_velocity)
        warn(fmt::format("granules are carried out: {:.3g} m/s at the plate, terminal velocity {:.3g} m/s",
                         out.plate_velocity, out.terminal_velocity));
    if (data.gas.drag == "beetstra" && out.reynolds > 1000)
        warn(fmt::format("gas.drag: beetstra is fitted up to Reynolds number 1000, the granules reach {:.4g}",
                         out.reynolds));
    if (out.cells > 1 && out.cell_over_parcel > 0 && out.cell_over_parcel < 1.5 && data.gas.smoothing == 0.0)
        warn(fmt::format("cells are only {:.2f} parcels wide: without gas.smoothing the voidage is noisy below 1.5",
                         out.cell_over_parcel));
    if (out.overlap > 0.10)
        warn(fmt::format(
            "contacts at {:.2g} m/s overlap by {:.0f} % of a radius (10 % is the limit): raise contact.youngs_modulus",
            out.overlap_speed, 100 * out.overlap));
    for (auto const& material : data.contact.materials)
        if (data.contact.conducts() && material.heat_conductivity > 0 && material.real_youngs_modulus == 0 &&
            material.name != "wall" && material.youngs_modulus < 1e9)
            warn(
                fmt::format("contacts of \"{}\" are as wide as those of granules of {:.3g} Pa, and pass as much heat: "
                            "state contact.real_youngs_modulus",
                            material.name, material.youngs_modulus));
    if (data.granules.parcel_ratio > 10)
        warn(fmt::format("a parcel stands for {:.0f} granules: mixing and contact statistics are coarse",
                         std::pow(data.granules.parcel_ratio, 3)));
    if (!out.bounds.empty() &&
        out.granule_step >
            1.0001 * std::min_element(out.bounds.begin(), out.bounds.end(), [](auto const& a, auto const& b) {
                         return a.seconds < b.seconds;
                     })->seconds)
        warn("time.granule_step is above the recommended bound");
    if (data.spray.present && !data.spray.nozzles.empty() && data.product.illustrative)
        warn("product: the porosity coefficients are illustrative; fit them to measurements of your product");
    if (data.spray.atomisation != "none")
        warn(fmt::format("spray.atomisation: {} is a correlation for trends; measure the droplets of your nozzle",
                         data.spray.atomisation));
    if (out.balance && out.balance->overwetted())
        warn("the air cannot take up the sprayed water: the bed will over-wet");
    for (auto const& nozzle : data.spray.nozzles)
        if (out.bed_height > 0 && nozzle.position.z < data.chamber.bottom() + out.bed_height)
            warn(fmt::format("a nozzle at {:.3g} m lies below the top of the settled bed ({:.3g} m)", nozzle.position.z,
                             out.bed_height));
}
}

std::optional<double> settled_height(Case const& data)
{
    double const needed = data.granules.mass / data.granules.density / settled_solids;
    double const bottom = data.chamber.bottom();
    double low = bottom, high = data.chamber.top();
    if (!(needed <= data.chamber.volume())) return std::nullopt;
    for (int i = 0; i < 60; ++i) {
        double const middle = 0.5 * (low + high);
        (data.chamber.volume(bottom, middle) < needed ? low : high) = middle;
    }
    return high - bottom;
}

double plate_velocity(Case const& data)
{
    double flow = 0;
    for (auto const& inlet : data.gas.inlets)
        if (inlet.at.direction == 2 && !inlet.at.upper) flow += moist_mass_flow(data, inlet);
    return flow > 0 ? flow / (gas_density(data) * data.chamber.area(data.chamber.bottom())) : 0;
}

double expected_contact_speed(Case const& data)
{
    return std::max({1.0, plate_velocity(data), fastest_meeting(data) + fastest_wall(data)});
}

std::vector<dem::StepBound> granule_step_bounds(Case const& data, double speed)
{
    return dem::step_bounds(granule_settings(data).laws, granule_kinds(data), speed);
}

bool has_balance(Case const& data)
{
    return data.gas.present && !data.gas.density && dry_inlet_flow(data) > 0;
}

Forecast forecast(Case const& data, int ranks)
{
    Forecast out;
    auto const& granules = data.granules;
    out.parcels = granules.parcels;
    out.granules = static_cast<double>(granules.parcels) * std::pow(granules.parcel_ratio, 3);
    out.plate_velocity = plate_velocity(data);
    if (out.parcels > 0) {
        double const radius = parcel_radius(data);
        out.parcel_diameter = 2 * radius;
        out.contact_speed = expected_contact_speed(data);
        if (!data.contact.hard()) {  // hard spheres have no step and no overlap
            out.overlap_speed = std::max({0.5, 0.5 * out.plate_velocity, fastest_meeting(data)});
            out.overlap = largest_overlap(data, radius, out.overlap_speed) / radius;
            out.bounds = granule_step_bounds(data, out.contact_speed);
            double least = out.bounds.front().seconds;
            for (auto const& bound : out.bounds) least = std::min(least, bound.seconds);
            out.granule_step = data.time.granule_step.value_or(least);
        }
        if (granules.mass > 0) out.bed_height = settled_height(data).value_or(0);
    }
    if (data.gas.present) {
        double const density = gas_density(data);
        double const viscosity = data.gas.viscosity.value_or(material::viscosity(data.gas.inlet.temperature));
        if (out.parcels > 0 && granules.density > density) {
            out.minimum_fluidisation = std::visit(
                [&](auto const& law) {
                    return law::drag::minimum_fluidisation_velocity(law, granules.diameter, granules.density, density,
                                                                    viscosity, packed_voidage);
                },
                law::drag::All::make(data.gas.drag).value());
            out.terminal_velocity =
                law::drag::terminal_velocity(granules.diameter, granules.density, density, viscosity);
            out.reynolds = density * out.plate_velocity * granules.diameter / viscosity;
        }
        auto const extent = data.chamber.upper() - data.chamber.lower();
        out.cells = 1;
        double narrow = extent.x, fast = std::max(0.1, 3 * out.plate_velocity);
        for (std::size_t i = 0; i < 3; ++i) {
            out.cells *= data.gas.cells[i];
            out.cell_size[i] = extent[i] / data.gas.cells[i];
            if (data.gas.cells[i] > 1) narrow = std::min(narrow, out.cell_size[i]);
        }
        if (out.parcel_diameter > 0) out.cell_over_parcel = narrow / out.parcel_diameter;
        // The jet where it is fastest: momentum of a Gaussian profile that has become 1.2 cells wide at half its
        // height.
        constexpr double jet = 0.55;
        for (auto const& nozzle : data.spray.nozzles)
            fast = std::max(fast, jet * std::sqrt(nozzle.air_mass_flow * nozzle.air_velocity / density) / narrow);
        out.gas_step = data.time.gas_step.value_or(
            std::min(narrow / fast, out.granule_step > 0 ? 50 * out.granule_step : INFINITY));
    }
    if (has_balance(data)) out.balance = balance(data);

    double const parcels = static_cast<double>(out.parcels), cells = static_cast<double>(out.cells);
    double const each = bytes_per_parcel + (data.gas.present ? bytes_of_gas_and_layer : 0);
    out.memory = parcels * each + cells * bytes_of_a_cell + ranks * bytes_per_rank;
    add_warnings(data, out);
    return out;
}
}
