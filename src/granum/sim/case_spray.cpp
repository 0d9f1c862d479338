// Reads [spray] with its nozzles, and the process: [drying], [product], [start], [time], [output].
#include "granum/law/atomising/droplets.hpp"
#include "granum/law/atomising/orifice.hpp"
#include "granum/law/deposit/stages.hpp"
#include "granum/law/droplet/size.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/law_families.hpp"

#include <cmath>

namespace granum::sim
{
using io::Dimension;

namespace
{
constexpr double locked_suspension = 0.6;  // recalled: 0.55 to 0.64

//! Flow and momentum of the atomising air from its pressure.
void read_pressed_air(io::CaseFile& file, std::string const& key, double ambient, NozzleCase& nozzle)
{
    for (auto const* name : {"air", "air_velocity"})
        if (file.has(key + name)) file.mistake(key + name, "follows from air_pressure", {"give one of the two"});
    law::atomising::Orifice orifice{.temperature = nozzle.air_temperature, .ambient = ambient};
    orifice.pressure = file.quantity(key + "air_pressure", Dimension::pressure, std::nullopt,
                                     "of the atomising air before the mouth, absolute; instead of air and air_velocity",
                                     {.low = ambient, .low_allowed = false});
    orifice.area =
        file.quantity(key + "air_mouth", Dimension::area, std::nullopt, "through which the air leaves", io::positive);
    orifice.discharge =
        file.quantity(key + "discharge", Dimension::one, orifice.discharge,
                      "share of the mouth that the air fills (recalled)", {.low = 0, .high = 1, .low_allowed = false});
    if (!std::isfinite(orifice.pressure + orifice.area)) return;
    double const flow = orifice.mass_flow();
    nozzle.air_mass_flow = flow / (1 + nozzle.air_humidity);
    nozzle.air_velocity = orifice.thrust() / flow;
    nozzle.air_pressure = orifice.pressure;
    nozzle.air_mouth = orifice.area;
    file.derived(key + "air", fmt::format("{:.4g} kg/h", 3600 * nozzle.air_mass_flow),
                 orifice.choked() ? "as fast as sound at the mouth" : "slower than sound at the mouth");
    file.derived(key + "air_velocity", fmt::format("{:.4g} m/s", nozzle.air_velocity),
                 "once it is at the chamber's pressure");
}

//! Median of a nozzle's droplets by a correlation, m.
void atomise(io::CaseFile& file, std::string const& key, double ambient, SprayCase const& spray, double rate,
             NozzleCase& nozzle)
{
    auto const needs = [&](char const* name, bool there, char const* what) {
        if (!there) file.mistake(key + name, fmt::format("is what {} needs of a nozzle: {}", spray.atomisation, what));
        return there;
    };
    if (file.wrong(key + "air_pressure") || file.wrong(key + "air_mouth")) return;
    bool good = needs("bore", nozzle.bore > 0, "the diameter of the liquid's mouth");
    good = needs("air", nozzle.air_mass_flow > 0, "atomising air") && good;
    if (spray.atomisation == law::atomising::Walzel::card.name)
        good = needs("air_pressure", nozzle.air_pressure > 0, "the pressure of the atomising air") && good;
    else if (std::abs(nozzle.air_velocity - nozzle.droplet_velocity) < 1)
        file.mistake(key + "droplet_velocity", "is that of the air: nothing tears the liquid", {}), good = false;
    if (!good) return;
    law::atomising::Atomisation const at{
        .liquid_flow = rate,
        .air_flow = nozzle.air_mass_flow * (1 + nozzle.air_humidity),
        .air_excess_pressure = nozzle.air_pressure - ambient,
        .air_density = material::density(ambient, nozzle.air_temperature, material::fraction(nozzle.air_humidity)),
        .air_velocity = std::abs(nozzle.air_velocity - nozzle.droplet_velocity),
        .density = spray.density,
        .viscosity = spray.viscosity,
        .surface_tension = spray.surface_tension,
        .bore = nozzle.bore};
    auto const law = law::atomising::Droplets::make(spray.atomisation);
    double const sauter = std::visit([&](auto const& one) { return one(at); }, *law);
    nozzle.droplet_median = law::droplet::shifted(sauter, spray.droplet_spread, 0.5);
    file.derived(key + "droplet_median", fmt::format("{:.4g} um", 1e6 * nozzle.droplet_median),
                 fmt::format("by {}: Sauter diameter {:.4g} um", spray.atomisation, 1e6 * sauter));
}

//! What makes the liquid a melt.
void read_melt(io::CaseFile& file, SprayCase& spray)
{
    spray.melting_point =
        file.optional_quantity("spray.melting_point", Dimension::temperature,
                               "of a melt, which solidifies and does not dry", {.low = 273.15, .high = 700})
            .value_or(0);
    bool const melt = spray.melting_point > 0;
    auto const property = [&](char const* key, Dimension dimension, double& value, char const* doc) {
        if (melt)
            value = file.quantity(key, dimension, std::nullopt, doc, io::positive);
        else if (file.know(key); file.has(key))
            file.mistake(key, "has no meaning without spray.melting_point");
    };
    property("spray.fusion_heat", Dimension::specific_energy, spray.fusion_heat,
             "that a melt gives when it solidifies");
    property("spray.conductivity", Dimension::conductivity, spray.conductivity, "of melt and granule under it");
    if (!melt) return;
    for (auto const* name :
         {"solubility", "molar_mass", "dissociation", "locking", "solids_diffusivity", "crust_diffusivity"})
        if (auto const key = std::string("spray.") + name; file.has(key))
            file.mistake(key, "has no meaning for a melt", {"leave it out, or leave out spray.melting_point"});
}

NozzleCase read_nozzle(io::CaseFile& file, std::string const& key, double ambient, Purpose purpose)
{
    NozzleCase nozzle;
    bool const placed = purpose == Purpose::run;
    nozzle.position =
        file.vector(key + "position", Dimension::length, placed ? std::nullopt : std::optional(math::Vec3{}),
                    "of the mouth, above the middle of the plate");
    nozzle.direction = file.vector(key + "direction", Dimension::one, nozzle.direction, "of the spray; any length");
    double const length = norm(nozzle.direction);
    if (length > 0)
        nozzle.direction = nozzle.direction / length;
    else
        file.mistake(key + "direction", "has no length");
    nozzle.half_angle = file.quantity(key + "half_angle", Dimension::angle, nozzle.half_angle,
                                      "of the cone of droplets", {.low = 0, .high = math::pi / 2});
    nozzle.air_mass_flow =
        file.quantity(key + "air", Dimension::mass_flow, 0.0, "atomising air, dry", io::not_negative);
    nozzle.air_temperature = file.quantity(key + "air_temperature", Dimension::temperature, nozzle.air_temperature,
                                           "of the atomising air", {.low = 233.15, .high = 473.15});
    nozzle.air_humidity =
        file.quantity(key + "air_humidity", Dimension::one, 0.0, "kg water per kg dry air", io::not_negative);
    nozzle.air_velocity = file.quantity(key + "air_velocity", Dimension::velocity, nozzle.air_velocity,
                                        "of the atomising air at the mouth", io::not_negative);
    if (file.has(key + "air_pressure"))
        read_pressed_air(file, key, ambient, nozzle);
    else
        for (auto const* name : {"air_mouth", "discharge"})
            if (file.know(key + name); file.has(key + name)) file.mistake(key + name, "needs air_pressure");
    nozzle.bore = file.quantity(key + "bore", Dimension::length, 0.0, "diameter of the liquid's mouth; 0: not told",
                                io::not_negative);
    nozzle.droplet_velocity = file.quantity(key + "droplet_velocity", Dimension::velocity, nozzle.droplet_velocity,
                                            "of the droplets at the mouth", io::not_negative);
    return nozzle;
}
}

void read_spray(io::CaseFile& file, Case& data, Purpose purpose)
{
    SprayCase& spray = data.spray;
    spray.present = file.has("spray");
    int const nozzles = file.count("nozzle");
    if (!spray.present) {
        if (nozzles > 0) file.mistake("nozzle", "needs a [spray]", {"add [spray] with its rate and liquid"});
        return;
    }
    if (!data.gas.present) file.mistake("spray", "needs a [gas] to dry it");
    spray.liquid = take_material(file, "spray.liquid", {"spray"});
    spray.rate = file.quantity("spray.rate", Dimension::mass_flow, std::nullopt, "liquid of all nozzles together",
                               io::not_negative);
    read_melt(file, spray);
    bool const whole = purpose == Purpose::run, melt = spray.melting_point > 0;
    spray.solids_fraction =
        file.quantity("spray.solids_fraction", Dimension::one, melt ? std::optional(1.0) : std::nullopt,
                      "kg solids per kg liquid; 1: a melt", {.low = melt ? 1.0 : 0, .high = melt ? 1 : 0.99});
    spray.temperature =
        file.quantity("spray.temperature", Dimension::temperature, melt ? spray.melting_point : spray.temperature,
                      "of the liquid", {.low = melt ? spray.melting_point : 273.15, .high = melt ? 700 : 373.15});
    auto const property = [&](char const* key, Dimension dimension, double value, char const* doc, io::Range range) {
        return file.quantity(std::string("spray.") + key, dimension, whole ? std::nullopt : std::optional(value), doc,
                             range);
    };
    spray.density = property("density", Dimension::density, spray.density, "of the liquid", io::positive);
    spray.viscosity = property("viscosity", Dimension::viscosity, spray.viscosity, "of the liquid", io::positive);
    spray.surface_tension =
        property("surface_tension", Dimension::surface_tension, spray.surface_tension, "of the liquid", io::positive);
    spray.solids_density = property("solids_density", Dimension::density, spray.solids_density,
                                    "of the dry solids without pores", io::positive);
    if (melt) {
        spray.solubility = 0;
        for (auto const* key : {"spray.solubility", "spray.molar_mass", "spray.dissociation"}) file.know(key);
    } else {
        spray.solubility = property("solubility", Dimension::one, spray.solubility,
                                    "kg solids per kg water; 0: a suspension", io::not_negative);
        spray.molar_mass =
            property("molar_mass", Dimension::molar_mass, spray.molar_mass, "of the solute", io::positive);
        spray.dissociation = property("dissociation", Dimension::one, spray.dissociation,
                                      "ions per molecule (van 't Hoff)", io::positive);
    }
    spray.contact_angle = property("contact_angle", Dimension::angle, spray.contact_angle, "of a droplet on a granule",
                                   {.low = 0, .high = math::pi, .low_allowed = false});
    spray.locking = file.quantity(
        "spray.locking", Dimension::one,
        whole && !melt && spray.solubility == 0 ? std::optional(locked_suspension) : spray.locking,
        "share of a droplet's volume at which solids at its surface lock; 0: they never do", {.low = 0, .high = 0.74});
    spray.solids_diffusivity =
        file.quantity("spray.solids_diffusivity", Dimension::diffusivity, spray.solids_diffusivity,
                      "of the solids in the liquid: slow ones gather at the surface; 0: they do not", io::not_negative);
    spray.crust_diffusivity =
        file.quantity("spray.crust_diffusivity", Dimension::diffusivity, spray.crust_diffusivity,
                      "of vapour through the crust of a droplet; 0: as without a crust", io::not_negative);
    auto& splash = spray.splash;
    splash.limit = file.quantity("spray.splash_limit", Dimension::one, splash.limit,
                                 "Mundo's number Oh Re^1.25 above which droplets splash (recalled)", io::positive);
    splash.least = file.quantity("spray.splash_least", Dimension::one, splash.least,
                                 "share of a droplet that splashes off at least (recalled)", io::zero_to_one);
    splash.range = file.quantity("spray.splash_range", Dimension::one, splash.range,
                                 "share by which this varies (recalled)", io::zero_to_one);
    splash.droplets = file.quantity("spray.splash_droplets", Dimension::one, splash.droplets,
                                    "number of droplets that fly on from one that splashes (recalled)", {.low = 1});
    if (splash.least + splash.range >= 1)
        file.mistake("spray.splash_range", "leaves nothing of a droplet on the granule",
                     {"splash_least and splash_range together are below 1"});
    double const feed_volume = spray.solids_fraction * spray.density / spray.solids_density;
    if (spray.locking > 0 && spray.locking <= feed_volume)
        file.mistake("spray.locking",
                     fmt::format("is not above the share that solids have in the feed, {:.3g}", feed_volume));
    spray.droplet_median = file.quantity("spray.droplet_median", Dimension::length, spray.droplet_median,
                                         "diameter, of the volume distribution", io::positive);
    spray.droplet_spread = file.quantity("spray.droplet_spread", Dimension::one, spray.droplet_spread,
                                         "geometric standard deviation", {.low = 1, .high = 5});
    spray.size = read_sizes(file, "spray.");
    auto atomising = laws_for("spray.atomisation");
    atomising.insert(atomising.begin(), "none");
    spray.atomisation =
        file.name("spray.atomisation", spray.atomisation, "correlation for the size of the droplets, for trends only",
                  atomising, "a correlation");
    if (spray.size)
        for (auto const* key : {"spray.droplet_median", "spray.droplet_spread"})
            if (file.has(key)) file.mistake(key, "does not go with spray.size", {"give one of the two"});
    if (spray.atomisation != "none")
        for (auto const* key : {"spray.droplet_median", "spray.size"})
            if (file.has(key)) file.mistake(key, "does not go with spray.atomisation", {"give one of the two"});
    spray.parcels_per_second = file.quantity("spray.parcels_per_second", Dimension::count_rate,
                                             spray.parcels_per_second, "droplet parcels made per second", io::positive);
    spray.capture = file.name("spray.capture", spray.capture, "law", laws_for("spray.capture"), "a capture law");
    spray.reach = file.optional_quantity("spray.reach", Dimension::length,
                                         "within which a droplet strikes granules, along each direction", io::positive);
    spray.dispersion = file.name("spray.dispersion", spray.dispersion, "law", laws_for("gas.dispersion"),
                                 "a law of turbulent dispersion");
    if (spray.dispersion != "none") need_eddies(file, "spray.dispersion", data.gas);
    spray.allow_overwetting =
        file.boolean("spray.allow_overwetting", false, "run even if the air cannot take up the water");
    for (int i = 0; i < nozzles; ++i)
        spray.nozzles.push_back(read_nozzle(file, fmt::format("nozzle[{}].", i), data.gas.pressure, purpose));
    if (spray.atomisation != "none" && whole)
        for (int i = 0; i < nozzles; ++i)
            atomise(file, fmt::format("nozzle[{}].", i), data.gas.pressure, spray, spray.rate / nozzles,
                    spray.nozzles[static_cast<std::size_t>(i)]);
    if (whole && nozzles == 0) file.mistake("spray", "has no nozzle", {"add a [[nozzle]] with its position"});
}

namespace
{
void read_sorption(io::CaseFile& file, Case& data)
{
    auto& drying = data.drying;
    drying.sorption =
        file.name("drying.sorption", drying.sorption, "law", laws_for("drying.sorption"), "a law of sorption");
    bool const none = drying.sorption == law::vapour::NoSorption::card.name;
    auto& gab = drying.gab;
    gab.monolayer = file.quantity("drying.sorption_monolayer", Dimension::one, gab.monolayer,
                                  "X_m, kg water per kg core", io::positive);
    gab.c = file.quantity("drying.sorption_c", Dimension::one, gab.c, "C", io::positive);
    gab.k = file.quantity("drying.sorption_k", Dimension::one, gab.k, "K", {.low = 0, .high = 1, .low_allowed = false});
    drying.sorption_time = file.quantity("drying.sorption_time", Dimension::time, drying.sorption_time,
                                         "in which absorbed water comes to 1/e of its way", io::positive);
    drying.absorbed =
        file.optional_quantity("drying.absorbed", Dimension::one,
                               "kg water per kg core at the start; otherwise in equilibrium", io::not_negative);
    for (auto const* name : {"sorption_monolayer", "sorption_c", "sorption_k", "sorption_time", "absorbed"})
        if (auto const key = std::string("drying.") + name; none && file.has(key))
            file.mistake(key, "belongs to drying.sorption = \"gab\"");
    if (!none && !data.spray.present) file.mistake("drying.sorption", "goes with a [spray]");
}

void read_abrasion(io::CaseFile& file, Case& data)
{
    auto& drying = data.drying;
    drying.abrasion =
        file.name("drying.abrasion", drying.abrasion, "law", laws_for("drying.abrasion"), "a law of abrasion");
    bool const none = drying.abrasion == law::layer::NoAbrasion::card.name;
    drying.abrasion_threshold =
        file.quantity("drying.abrasion_threshold", Dimension::specific_energy, drying.abrasion_threshold,
                      "per kg of granule and collision, below which nothing is rubbed off", io::not_negative);
    if (none) {
        for (auto const* key : {"drying.abrasion_coefficient", "drying.abrasion_threshold"})
            if (file.has(key)) file.mistake(key, "belongs to drying.abrasion = \"collision-energy\"");
        return;
    }
    drying.collision_energy.coefficient =
        file.quantity("drying.abrasion_coefficient", Dimension::mass_per_energy, std::nullopt,
                      "kg of layer per J that collisions dissipate", io::positive);
    if (!data.spray.present) file.mistake("drying.abrasion", "goes with a [spray]");
    if (data.contact.hard()) file.mistake("drying.abrasion", "needs soft spheres");
}

void read_crystallisation(io::CaseFile& file, Case& data)
{
    auto& drying = data.drying;
    drying.crystallisation = file.name("drying.crystallisation", drying.crystallisation, "law",
                                       laws_for("drying.crystallisation"), "a law of crystallisation");
    bool const at_saturation = drying.crystallisation == law::deposit::AtSaturation::card.name;
    if (!at_saturation && data.spray.present && data.spray.solubility == 0)
        file.mistake("drying.crystallisation", "needs a solution",
                     {"spray.solubility says how much of the solids water can hold"});
    auto& law = drying.crystals;
    law.nucleation = file.quantity("drying.nucleation", Dimension::count_flux, law.nucleation,
                                   "k of k (S - 1)^b crystals born on the base", io::positive);
    law.nucleation_order =
        file.quantity("drying.nucleation_order", Dimension::one, law.nucleation_order, "b", io::positive);
    law.growth = file.quantity("drying.growth", Dimension::velocity, law.growth,
                               "g of g (S - 1)^c by which the length of crystals grows", io::positive);
    law.growth_order = file.quantity("drying.growth_order", Dimension::one, law.growth_order, "c", io::positive);
    law.shape = file.quantity("drying.crystal_shape", Dimension::one, law.shape,
                              "volume of a crystal over the cube of its length", io::positive);
    for (auto const* name : {"nucleation", "nucleation_order", "growth", "growth_order", "crystal_shape"})
        if (auto const key = std::string("drying.") + name; at_saturation && file.has(key))
            file.mistake(key, "belongs to drying.crystallisation = \"nucleation-growth\"");
}
}

void read_process(io::CaseFile& file, Case& data)
{
    data.drying.deposit =
        file.name("drying.deposit", data.drying.deposit, "law", laws_for("drying.deposit"), "a law of deposit drying");
    DryingCase& drying = data.drying;
    drying.stages =
        file.name("drying.stages", drying.stages, "law", laws_for("drying.stages"), "a law of drying stages");
    bool const melt = data.spray.melting_point > 0;
    drying.solidification = file.name("drying.solidification", drying.solidification, "law",
                                      laws_for("drying.solidification"), "a law of solidification");
    if (!melt && file.has("drying.solidification"))
        file.mistake("drying.solidification", "has no meaning without spray.melting_point");
    for (auto const* name : {"deposit", "stages", "equilibrium_moisture", "critical_moisture", "film_coverage"})
        if (auto const key = std::string("drying.") + name; melt && file.has(key))
            file.mistake(key, "has no meaning for a melt");
    read_crystallisation(file, data);
    read_sorption(file, data);
    data.drying.roughness =
        file.quantity("drying.roughness", Dimension::length, data.drying.roughness,
                      "height of the asperities of granules, to which a film is squeezed", io::positive);
    read_abrasion(file, data);
    bool const rea = drying.stages == law::deposit::ReactionEngineering::card.name;
    drying.critical_moisture =
        file.quantity("drying.critical_moisture", Dimension::one, 0.0,
                      "kg water per kg solids below which drying slows; 0: none", io::not_negative);
    drying.falling_exponent = file.quantity("drying.falling_exponent", Dimension::one, drying.falling_exponent,
                                            "of the falling rate", io::positive);
    std::array<char const*, 3> const numbers{"drying.rea_a", "drying.rea_b", "drying.rea_c"};
    for (std::size_t k = 0; k < 3; ++k)
        drying.rea[k] =
            file.quantity(numbers[k], Dimension::one, drying.rea[k],
                          "of a exp(-b (X - X_eq)^c); the default is that of skim milk (recalled)", io::positive);
    for (auto const* key : {"drying.critical_moisture", "drying.falling_exponent"})
        if (rea && file.has(key)) file.mistake(key, "has no meaning for drying.stages = \"reaction-engineering\"");
    for (auto const* key : numbers)
        if (!rea && file.has(key)) file.mistake(key, "has no meaning for drying.stages = \"falling-rate\"");
    drying.equilibrium_moisture =
        file.quantity("drying.equilibrium_moisture", Dimension::one, drying.equilibrium_moisture,
                      "kg water per kg solids that stay in the layer", io::not_negative);
    double const feed = (1 - data.spray.solids_fraction) / data.spray.solids_fraction;
    if (data.spray.present && !melt && drying.equilibrium_moisture >= feed)
        file.mistake("drying.equilibrium_moisture", fmt::format("is not below the moisture of the feed, {:.4g}", feed));
    if (drying.critical_moisture > 0 && drying.critical_moisture <= drying.equilibrium_moisture)
        file.mistake("drying.critical_moisture", "is not above drying.equilibrium_moisture");
    drying.film_coverage = file.quantity("drying.film_coverage", Dimension::one, drying.film_coverage,
                                         "wet share of a granule above which its deposits dry as one film",
                                         {.low = 0, .high = 1, .low_allowed = false});
    drying.merge = file.boolean("drying.merge", drying.merge, "a droplet that falls on a wet deposit joins it");
    data.drying.end_moisture = file.quantity("drying.end_moisture", Dimension::one, data.drying.end_moisture,
                                             "share of the feed's moisture at which a deposit counts as dry",
                                             {.low = 0, .high = 1, .low_allowed = false});

    ProductCase& product = data.product;
    product.porosity_model = file.name("product.porosity_model", product.porosity_model, "law",
                                       laws_for("product.porosity_model"), "a porosity model");
    product.porosity_at_zero = file.quantity("product.porosity_at_zero", Dimension::one, product.porosity_at_zero,
                                             "layer porosity at drying potential 0", io::zero_to_one);
    product.porosity_slope = file.quantity("product.porosity_slope", Dimension::one, product.porosity_slope,
                                           "change of porosity per drying potential", {.low = -5, .high = 5});
    product.porosity_band = file.quantity("product.porosity_band", Dimension::one, product.porosity_band,
                                          "standard deviation about the line", io::zero_to_one);
    product.illustrative =
        file.boolean("product.illustrative", true, "coefficients not fitted to measurements of this product");

    StartCase& start = data.start;
    start.quasi_steady =
        file.boolean("start.quasi_steady", data.spray.present, "bed, gas and surface moisture from the balance");
    start.temperature_offset = file.quantity("start.temperature_offset", Dimension::temperature_difference, 0.0,
                                             "added to the bed temperature of the balance", {.low = -100, .high = 100});
    io::Range const warm{.low = 233.15, .high = 473.15};
    start.bed_temperature =
        file.optional_quantity("start.bed_temperature", Dimension::temperature, "instead of the balance's", warm);
    start.gas_temperature =
        file.optional_quantity("start.gas_temperature", Dimension::temperature,
                               "instead of the inlet's or the balance's, and of the granules' between them", warm);
    bool const told =
        start.temperature_offset != 0 || start.bed_temperature || start.gas_temperature || file.count("phase") > 0;
    start.settling = file.quantity(
        "start.settling", Dimension::time, start.quasi_steady && !told ? 15.0 : 0.0,
        "at most, in which the bed's mean temperature goes to where the process holds it, bypassing its heat capacity",
        {.low = 0, .high = 1e4});
}
}
