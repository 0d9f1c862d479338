#include "granum/sim/build.hpp"

#include "granum/base/error.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/math/constants.hpp"
#include "granum/sim/forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace granum::sim
{
namespace
{
//! The law called `name`; the case reader has checked the name, so a miss is a defect of ours.
template <class List>
typename List::Any named(std::string const& name)
{
    auto law = List::make(name);
    base::require(law.has_value(), "there is no law called \"{}\"", name);
    return *law;
}

std::vector<geometry::Body> walls(Case const& data)
{
    auto const& chamber = data.chamber;
    std::vector<geometry::Body> out;
    if (chamber.shape == geometry::Chamber::Shape::solids) {
        out = data.bodies;
        out.insert(out.end(), data.walls.begin(), data.walls.end());
        return out;
    }
    auto const faces = [&](std::size_t axis) {
        constexpr std::array<std::array<char const*, 2>, 3> names{
            {{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};
        if (data.periodic[axis]) return;
        for (std::size_t high : {0u, 1u}) {
            if (data.open[axis][high]) continue;
            Vec3 normal;
            normal[axis] = high ? -1 : 1;
            out.push_back({.name = names[axis][high],
                           .shapes = {geometry::Plane{high ? chamber.upper() : chamber.lower(), normal}},
                           .material = 1});
        }
    };
    faces(2);
    if (chamber.shape == geometry::Chamber::Shape::box) {
        faces(0), faces(1);
    } else {
        geometry::Body wall{.name = "chamber", .shapes = {}, .material = 1};
        for (std::size_t p = 0; p + 1 < chamber.profile.size(); ++p) {
            auto const &from = chamber.profile[p], &to = chamber.profile[p + 1];
            wall.shapes.push_back(geometry::Frustum{.base = {0, 0, from.height},
                                                    .axis = {0, 0, 1},
                                                    .length = to.height - from.height,
                                                    .base_radius = from.radius,
                                                    .top_radius = to.radius,
                                                    .side = geometry::Side::inside});
        }
        out.push_back(std::move(wall));
    }
    out.insert(out.end(), data.bodies.begin(), data.bodies.end());
    out.insert(out.end(), data.walls.begin(), data.walls.end());
    return out;
}

//! A speed at which granules are expected to meet, m/s: it enters the Hertz contact time with the power -1/5 only.
double collision_speed(Case const& data)
{
    double fastest = 1.0;
    if (data.gas.present && !data.gas.closed) {
        double flow = 0;
        for (auto const& inlet : data.gas.inlets) flow += moist_mass_flow(data, inlet);
        double const density = data.gas.density ? *data.gas.density
                                                : material::density(data.gas.pressure, data.gas.inlet.temperature,
                                                                    material::fraction(data.gas.inlet.humidity));
        fastest = std::max(fastest, flow / (density * data.chamber.area(data.chamber.bottom())));
    }
    return std::max(fastest, fastest_meeting(data) + fastest_wall(data));
}

//! k_n of `linear`, N/m, for a pair whose effective mass is `share` of a granule's: as given, or so that the contact of
//! two of the smallest granules lasts contact.contact_time, and contact with a wall lasts as long.
double linear_stiffness(Case const& data, ContactPair const& pair, double share)
{
    auto const& contact = data.contact;
    if (!contact.contact_time || contact.hard()) return pair.stiffness;
    auto const attraction = contact.keep_attraction ? law::contact::Attraction::keep : law::contact::Attraction::cut;
    double const zeta = law::contact::damping_ratio(pair.restitution, attraction);
    double const rate = law::contact::contact_phase(zeta, attraction) / *contact.contact_time;
    double lightest = std::numeric_limits<double>::infinity();
    for (auto const& kind : granule_kinds(data))
        lightest = std::min(lightest, kind.density * 4 / 3 * math::pi * kind.radius * kind.radius * kind.radius);
    return share * lightest * rate * rate;
}
}

dem::Settings granule_settings(Case const& data)
{
    dem::Settings settings;
    auto const& contact = data.contact;
    dem::Laws& laws = settings.laws;
    laws.normal = named<law::contact::NormalLaws>(contact.normal);
    laws.tangential = named<law::contact::TangentialLaws>(contact.tangential);
    laws.rolling = named<law::contact::RollingLaws>(contact.rolling);
    std::visit(
        [&](auto& law) {
            if constexpr (requires { law.attraction; })
                law.attraction =
                    contact.keep_attraction ? law::contact::Attraction::keep : law::contact::Attraction::cut;
        },
        laws.normal);
    settings.wear_threshold = data.drying.abrasion_threshold;
    laws.lever = contact.lever_radius ? dem::Lever::radius : dem::Lever::contact_point;
    auto const grains = granule_kinds(data);
    for (std::uint32_t number = 0; number < contact.materials.size(); ++number) {
        auto const& m = contact.materials[number];
        bool const granular =
            std::any_of(grains.begin(), grains.end(), [&](auto const& g) { return g.material == number; });
        laws.add({.youngs_modulus = m.youngs_modulus,
                  .poisson_ratio = m.poisson_ratio,
                  .rigid = m.rigid,
                  .wall = number > 0 && !granular});
    }
    for (std::uint32_t a = 0; a < contact.pairs.size(); ++a)
        for (std::uint32_t b = 0; b <= a; ++b) {
            auto const& pair = contact.pairs[a][b];
            laws.pair(a, b,
                      {.restitution = pair.restitution,
                       .sliding_friction = pair.sliding_friction,
                       .rolling_friction = pair.rolling_friction,
                       .rolling_damping = pair.rolling_damping,
                       .stiffness = linear_stiffness(data, pair, laws.is_wall(a) || laws.is_wall(b) ? 1 : 0.5),
                       .tangential_ratio = contact.tangential_ratio});
        }
    laws.reference.speed = contact.reference_speed;
    auto const smallest = std::min_element(
        grains.begin(), grains.end(), [](auto const& one, auto const& other) { return one.radius < other.radius; });
    if (smallest != grains.end()) {
        laws.reference.radius = smallest->radius;
        laws.reference.density = smallest->density;
    }
    settings.walls = walls(data);
    settings.lower = data.chamber.lower();
    settings.upper = data.chamber.upper();
    settings.periodic = data.periodic;
    settings.gravity = data.gravity;
    settings.frozen = data.granules.frozen;
    settings.largest_radius = largest_radius(data);
    // Granules may grow by a tenth before their gas is cut short.
    if (data.contact.films()) settings.sight = 1.1 * data.contact.film_lens * settings.largest_radius;
    return settings;
}

dem::HardOptions hard_options(Case const& data)
{
    dem::HardOptions options{.tangential_restitution = data.contact.tangential_restitution};
    options.contact_time = data.contact.contact_time.value_or(options.contact_time);
    return options;
}

particle::Groups column_groups(Case const& data)
{
    bool const gas = data.gas.present;
    auto const& granules = data.granules;
    bool const parcels =
        granules.parcel_ratio > 1 ||
        std::any_of(granules.batches.begin(), granules.batches.end(),
                    [](auto const& b) { return b.parcel_ratio > 1; }) ||
        std::any_of(granules.given.begin(), granules.given.end(), [](auto const& one) { return one.count != 1; });
    auto const& forces = data.gas.forces;
    return {.parcel = gas || parcels,
            .gas = gas,
            .process = gas,
            .added_mass = gas && (forces.virtual_mass != "none" || forces.history > 0),
            .turning = gas && forces.torque != "none",
            .eddies = gas && data.gas.dispersion != "none",
            .collisions = gas && data.spray.present && !data.contact.hard()};
}

double smoothing(Case const& data)
{
    // As wide as cells of three diameters make the weights: from there on results hardly depend on the cells.
    constexpr double diameters = 1.22;
    return data.gas.smoothing.value_or(diameters * 2 * largest_radius(data));
}

double capture_reach(Case const& data)
{
    return data.spray.reach.value_or(3 * 2 * largest_radius(data));
}

coupling::Scheme mapping_scheme(Case const& data)
{
    return data.gas.mapping == "centre"    ? coupling::Scheme::centre
           : data.gas.mapping == "divided" ? coupling::Scheme::divided
                                           : coupling::Scheme::kernel;
}

namespace
{
law::dispersion::Any dispersion(Case const& data, std::string const& name)
{
    auto law = named<law::dispersion::All>(name);
    if (auto* const langevin = std::get_if<law::dispersion::Langevin>(&law))
        langevin->time_ratio = data.gas.turbulence.memory;
    return law;
}
}

coupling::Laws exchange_laws(Case const& data)
{
    auto const& forces = data.gas.forces;
    return {.drag = named<law::drag::All>(data.gas.drag),
            .heat = named<law::heat::All>(data.gas.heat_transfer),
            .virtual_mass = named<law::force::VirtualMassLaws>(forces.virtual_mass),
            .shear_lift = named<law::force::ShearLiftLaws>(forces.shear_lift),
            .spin_lift = named<law::force::SpinLiftLaws>(forces.spin_lift),
            .torque = named<law::force::TorqueLaws>(forces.torque),
            .history = forces.history > 0,
            .polydisperse = forces.polydisperse,
            .filtered = forces.filtered,
            .emissivity = data.granules.emissivity,
            .dispersion = dispersion(data, data.gas.dispersion),
            .seed = data.seed};
}

coupling::Conduction conduction(Case const& data, par::Communicator const& comm)
{
    auto const& contact = data.contact;
    coupling::Paths paths{.contact = named<law::conduction::All>(contact.conduction),
                          .film = named<law::film::All>(contact.film),
                          .lens = contact.film_lens,
                          .shortest = contact.film_shortest,
                          .gas = data.gas.conductivity,
                          .collisions = contact.collisions};
    for (auto const& material : contact.materials)
        paths.materials.push_back({.conductivity = material.heat_conductivity,
                                   .youngs_modulus = material.real_youngs_modulus,
                                   .poisson_ratio = material.poisson_ratio,
                                   .softened_modulus = material.youngs_modulus,
                                   .rigid = material.rigid});
    for (auto const& body : walls(data)) {
        auto const& described = data.gas.walls;
        auto const own =
            std::find_if(described.begin(), described.end(), [&](auto const& w) { return w.of == body.name; });
        paths.walls.push_back(own != described.end() ? own->temperature : described.front().temperature);
    }
    return {std::move(paths), comm};
}

spray::Liquid spray_liquid(Case const& data)
{
    auto const& s = data.spray;
    return {.density = s.density,
            .viscosity = s.viscosity,
            .surface_tension = s.surface_tension,
            .solids_density = s.solids_density,
            .solids_fraction = s.solids_fraction,
            .solids_heat_capacity = data.granules.heat_capacity,
            .solubility = s.solubility,
            .molar_mass = s.molar_mass,
            .dissociation = s.dissociation,
            .contact_angle = s.contact_angle,
            .locking = s.locking,
            .solids_diffusivity = s.solids_diffusivity,
            .crust_diffusivity = s.crust_diffusivity,
            .melting_point = s.melting_point,
            .fusion_heat = s.fusion_heat};
}

std::vector<spray::Nozzle> nozzles(Case const& data)
{
    std::vector<spray::Nozzle> out;
    auto const& s = data.spray;
    double const share = s.nozzles.empty() ? 0 : 1.0 / static_cast<double>(s.nozzles.size());
    for (auto const& n : s.nozzles)
        out.push_back({.position = n.position,
                       .direction = n.direction,
                       .half_angle = n.half_angle,
                       .air_mass_flow = n.air_mass_flow * (1 + n.air_humidity),
                       .air_temperature = n.air_temperature,
                       .air_vapour_fraction = material::fraction(n.air_humidity),
                       .air_velocity = n.air_velocity,
                       .droplet_velocity = n.droplet_velocity,
                       .droplet_temperature = s.temperature,
                       .rate = s.rate * share,
                       .median = n.droplet_median > 0 ? n.droplet_median : s.droplet_median,
                       .spread = s.droplet_spread,
                       .sizes = s.size,
                       .parcels_per_second = s.parcels_per_second * share,
                       .number = out.size()});
    return out;
}

spray::FlightSettings flight_settings(Case const& data)
{
    auto const number = data.gas.cells;
    Vec3 const size = data.chamber.upper() - data.chamber.lower();
    double const cell = std::min({size.x / number[0], size.y / number[1], size.z / number[2]});
    return {.liquid = spray_liquid(data),
            .capture = named<law::capture::All>(data.spray.capture),
            .gravity = data.gravity,
            .pressure = data.gas.pressure,
            .end_moisture = data.drying.end_moisture,
            .splash = data.spray.splash,
            .longest_hop = 0.25 * cell,
            .dispersion = dispersion(data, data.spray.dispersion),
            .seed = data.seed};
}

product::Any porosity_model(Case const& data)
{
    auto model = named<product::All>(data.product.porosity_model);
    std::visit(
        [&](auto& law) {
            if constexpr (requires { law.slope; }) {
                law.zero = data.product.porosity_at_zero;
                law.slope = data.product.porosity_slope;
                law.band = law.common = data.product.porosity_band;
            }
        },
        model);
    return model;
}

drying::Settings drying_settings(Case const& data)
{
    auto const& s = data.spray;
    drying::Settings settings;
    settings.combine = named<law::deposit::All>(data.drying.deposit);
    settings.liquid = {.density = s.density,
                       .solids_density = s.solids_density,
                       .solubility = s.solubility,
                       .molar_mass = s.molar_mass,
                       .dissociation = s.dissociation,
                       .feed_moisture = spray_liquid(data).feed_moisture(),
                       .melting_point = s.melting_point,
                       .conductivity = s.conductivity};
    settings.solidification = named<law::deposit::Solidification>(data.drying.solidification);
    settings.stages = named<law::deposit::Stages>(data.drying.stages);
    std::visit(
        [&](auto& law) {
            using Law = std::decay_t<decltype(law)>;
            if constexpr (std::is_same_v<Law, law::deposit::FallingRate>)
                law = {.critical = data.drying.critical_moisture, .exponent = data.drying.falling_exponent};
            else
                law = {.a = data.drying.rea[0], .b = data.drying.rea[1], .c = data.drying.rea[2]};
        },
        settings.stages);
    settings.crystallisation = named<law::deposit::Crystallisation>(data.drying.crystallisation);
    if (auto* law = std::get_if<law::deposit::NucleationGrowth>(&settings.crystallisation)) *law = data.drying.crystals;
    settings.sorption = named<law::vapour::Sorption>(data.drying.sorption);
    if (auto* law = std::get_if<law::vapour::Gab>(&settings.sorption)) *law = data.drying.gab;
    settings.sorption_time = data.drying.sorption_time;
    settings.viscosity = s.viscosity;
    settings.restitution = data.contact.pairs[0][0].restitution;
    settings.roughness = data.drying.roughness;
    settings.abrasion = named<law::layer::Abrasion>(data.drying.abrasion);
    if (auto* law = std::get_if<law::layer::CollisionEnergy>(&settings.abrasion)) *law = data.drying.collision_energy;
    settings.pores = {.share = data.granules.pores,
                      .radius = data.granules.pore_radius,
                      .viscosity = s.viscosity,
                      .surface_tension = s.surface_tension,
                      .contact_angle = s.contact_angle};
    settings.equilibrium_moisture = data.drying.equilibrium_moisture;
    settings.film_coverage = data.drying.film_coverage;
    settings.end_moisture = data.drying.end_moisture;
    settings.pressure = data.gas.pressure;
    settings.porosity = [model = porosity_model(data)](double potential, double time, double moisture) {
        return std::visit([&](auto const& law) { return law({potential, time, moisture}).mean; }, model);
    };
    return settings;
}

double largest_radius(Case const& data)
{
    double largest = 0;
    for (auto const& batch : data.granules.batches)
        largest = std::max(largest, 0.5 * batch.sizes.largest() * batch.parcel_ratio);
    for (auto const& one : data.granules.given) largest = std::max(largest, 0.5 * one.diameter * std::cbrt(one.count));
    return largest;
}

double density_of(Case const& data, GranuleCase const& one)
{
    double const of_material = data.contact.materials[one.material].density;
    return one.density > 0 ? one.density : of_material > 0 ? of_material : data.granules.density;
}

std::vector<dem::Grains> granule_kinds(Case const& data)
{
    std::vector<dem::Grains> out;
    for (auto const& batch : data.granules.batches)
        out.push_back({batch.material, 0.5 * batch.sizes.smallest() * batch.parcel_ratio, batch.density});
    std::map<std::uint32_t, dem::Grains> given;
    for (auto const& one : data.granules.given) {
        double const radius = 0.5 * one.diameter * std::cbrt(one.count);
        double const density = density_of(data, one);
        auto& kind = given.try_emplace(one.material, dem::Grains{one.material, radius, density}).first->second;
        kind.radius = std::min(kind.radius, radius);
        kind.density = std::min(kind.density, density);
    }
    for (auto const& [material, kind] : given) out.push_back(kind);
    return out;
}

double fastest_wall(Case const& data)
{
    double const reach = math::norm(data.chamber.upper() - data.chamber.lower()) / 2;
    double fastest = 0;
    for (auto const& body : data.walls) {
        double speed = 0;
        for (auto const& motion : body.motions) {
            if (auto const* moved = std::get_if<geometry::Translation>(&motion)) speed += math::norm(moved->velocity);
            if (auto const* turned = std::get_if<geometry::Rotation>(&motion)) speed += std::abs(turned->rate) * reach;
            if (auto const* shaken = std::get_if<geometry::Vibration>(&motion))
                speed += 2 * math::pi * shaken->frequency * shaken->amplitude;
            if (auto const* pressed = std::get_if<geometry::Servo>(&motion)) speed += pressed->fastest;
        }
        fastest = std::max(fastest, speed);
    }
    return fastest;
}

double fastest_meeting(Case const& data)
{
    double first = 0, second = 0;
    for (auto const& granule : data.granules.given) {
        double const speed = math::norm(granule.velocity);
        second = std::max(second, std::min(first, speed));
        first = std::max(first, speed);
    }
    return first + second;
}

double granule_step(Case const& data)
{
    if (data.time.granule_step) return *data.time.granule_step;
    double least = data.time.duration;
    if (data.contact.hard()) return 1e-3 * least;  // the first; the others follow from the collisions
    for (auto const& bound : granule_step_bounds(data, collision_speed(data))) least = std::min(least, bound.seconds);
    return least;
}
}
