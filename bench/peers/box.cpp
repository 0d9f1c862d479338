#include "peers/box.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <vector>

namespace granum::peers
{
namespace
{
dem::Settings settings_of(Vec3 const& upper, Touching const& touching, double skin)
{
    dem::Settings settings;
    settings.laws.normal = law::contact::HertzTsuji{touching.attraction};
    if (touching.rolling)
        settings.laws.rolling = law::contact::Epsd{};
    else
        settings.laws.rolling = law::contact::NoRolling{};
    settings.laws.lever = touching.lever;
    settings.laws.add({.youngs_modulus = 1e7, .poisson_ratio = 0.25});
    settings.laws.pair(0, 0,
                       {.restitution = touching.restitution,
                        .sliding_friction = touching.sliding_friction,
                        .rolling_friction = touching.rolling_friction});
    settings.lower = {0, 0, 0};
    settings.upper = upper;
    settings.gravity = {0, 0, -9.81};
    settings.skin = skin;
    settings.walls = {{geometry::Plane{{0, 0, 0}, {0, 0, 1}}, 0},
                      {geometry::Plane{{0, 0, 0}, {1, 0, 0}}, 0},
                      {geometry::Plane{{upper.x, 0, 0}, {-1, 0, 0}}, 0},
                      {geometry::Plane{{0, 0, 0}, {0, 1, 0}}, 0},
                      {geometry::Plane{{0, upper.y, 0}, {0, -1, 0}}, 0}};
    return settings;
}

// Slabs of about one diameter, cut so that each rank gets as many granules as the others.
par::Slabs cut(State const& state, long tiles_x, double largest, int ranks)
{
    double const length = state.length_x * static_cast<double>(tiles_x);
    auto const cells = std::max<std::size_t>(1, static_cast<std::size_t>(length / (2 * largest)));
    double const width = length / static_cast<double>(cells);
    std::vector<double> weight(cells, 0.0);
    for (long i = 0; i < tiles_x; ++i)
        for (auto const& sphere : state.spheres) {
            auto const cell = static_cast<std::size_t>(std::max(0.0, in_tile(state, sphere, i, 0).position.x / width));
            ++weight[std::min(cells - 1, cell)];
        }
    return par::Slabs::balanced(0, width, false, weight, ranks);
}
}

Box::Box(State const& state, long tiles_x, long tiles_y, Touching const& touching, double skin,
         par::Communicator const& comm)
{
    double largest = 0, top = 0;
    for (auto const& sphere : state.spheres) {
        largest = std::max(largest, sphere.radius);
        top = std::max(top, sphere.position.z);
    }
    slabs = cut(state, tiles_x, largest, comm.size());

    auto const for_each_own = [&](auto const& act) {
        std::uint64_t id = 0;
        for (long j = 0; j < tiles_y; ++j)
            for (long i = 0; i < tiles_x; ++i)
                for (auto const& base : state.spheres) {
                    ++id;
                    auto const sphere = in_tile(state, base, i, j);
                    if (slabs.owner(sphere.position.x) == comm.rank()) act(id, sphere);
                }
    };
    // Counted first, so that no column grows step by step and leaves its shorter self in the peak of memory.
    std::size_t mine = 0;
    for_each_own([&](auto, auto const&) { ++mine; });
    granules.resize(mine);
    granules.owned = mine;
    std::size_t row = 0;
    for_each_own([&](std::uint64_t id, Sphere const& sphere) {
        granules.id[row] = id;
        granules.position[row] = sphere.position;
        granules.velocity[row] = sphere.velocity;
        granules.spin[row] = sphere.spin;
        granules.radius[row] = sphere.radius;
        granules.diameter[row] = 2 * sphere.radius;
        granules.mass[row] = 4.0 / 3.0 * math::pi * sphere.radius * sphere.radius * sphere.radius * state.density;
        granules.count[row] = 1;
        ++row;
    });
    total = comm.sum(static_cast<long>(mine));

    Vec3 const upper{state.length_x * static_cast<double>(tiles_x), state.length_y * static_cast<double>(tiles_y),
                     std::max(0.2, 2 * top)};
    engine = std::make_unique<dem::Engine>(settings_of(upper, touching, skin), slabs, comm);
    engine->prepare(granules);
}

double Box::kinetic_energy(par::Communicator const& comm) const
{
    double sum = 0;
    for (std::size_t row = 0; row < granules.owned; ++row)
        sum += 0.5 * granules.mass[row] * norm2(granules.velocity[row]);
    return comm.sum(sum);
}

double Box::coordination(par::Communicator const& comm) const
{
    auto const& contacts = engine->contacts();
    long ends = 0;  // ends of touching pairs at granules of this rank
    for (std::size_t k = 0; k < contacts.pairs.size(); ++k) {
        if (!contacts.touching[k]) continue;
        ends += contacts.pairs[k].low < granules.owned ? 1 : 0;
        ends += contacts.pairs[k].high < granules.owned ? 1 : 0;
    }
    return static_cast<double>(comm.sum(ends)) / static_cast<double>(total);
}
}
