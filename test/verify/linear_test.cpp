// Rows D01 to D03, D11 and D12: spheres on linear springs and dashpots, against closed forms and the results of other
// codes. The dashpot is the one whose pull at the end of a contact is kept, as those references have it.
#include "granum/base/random.hpp"
#include "impact.hpp"
#include "scene/reference.hpp"
#include "table.hpp"

#include <map>

namespace
{
using namespace granum;
using namespace verify;

std::string linear(double stiffness, double tangential_ratio = 2.0 / 7)
{
    return fmt::format(
        "normal = \"linear\"\nstiffness = \"{} N/m\"\ntangential_ratio = {}\nkeep_attraction = true\nrolling = "
        "\"none\"",
        stiffness, tangential_ratio);
}

//! The sphere that references D01 and D02 drop from a height of 0.5 m.
std::unique_ptr<sim::Simulation> dropped(double stiffness, double restitution, double step)
{
    return simulate({.stuff = {1e9, 0.25, 2600},
                     .pair = {.restitution = restitution, .sliding_friction = 0, .rolling_friction = 0},
                     .granules = {{.position = {1, 1, 0.5}, .velocity = {}, .spin = {}}},
                     .radius = 0.1,
                     .step = step,
                     .size = {2, 2, 2},
                     .gravity = {0, 0, -9.80665},
                     .contact = linear(stiffness)});
}

TEST(LinearSpring, lets_a_sphere_fall_touch_and_rebound_as_the_closed_form_says)
{
    struct Off
    {
        double position = 0, velocity = 0, rebound = 0, overlap = 0, duration = 0;
    };
    std::map<double, Off> worst;
    scene::Table const table("dem-01.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        // Springs into which the sphere sinks by more than half its radius are refused.
        if (table.number(row, "max_overlap_m") > 0.05) continue;
        double const stiffness = table.number(row, "kn_N_per_m"), step = 1e-4;
        auto const simulation = dropped(stiffness, table.number(row, "e"), step);
        auto const& granules = simulation->granules();
        auto& off = worst[stiffness];
        auto const keep = [](double& largest, double difference) { largest = std::max(largest, std::abs(difference)); };
        double deepest = 0, duration = 0, rebound = 0;
        for (int k = 1; k <= 5000; ++k) {
            simulation->step(step);
            double const z = granules.position[0].z, v = granules.velocity[0].z;
            deepest = std::max(deepest, 0.1 - z);
            if (z < 0.1) duration += step;
            if (z < 0.1) rebound = v;
            if (k != 3000 && k != 5000) continue;
            auto const at = k == 3000 ? "0.3" : "0.5";
            keep(off.position, z - table.number(row, std::string("y_m_at_t") + at));
            keep(off.velocity, v - table.number(row, std::string("v_m_per_s_at_t") + at));
        }
        keep(off.overlap, deepest / table.number(row, "max_overlap_m") - 1);
        if (granules.position[0].z < 0.1) continue;
        keep(off.duration, duration / table.number(row, "contact_duration_s") - 1);
        keep(off.rebound, rebound / table.number(row, "rebound_velocity_m_per_s") - 1);
    }
    for (auto const& [stiffness, off] : worst) {
        auto const name = fmt::format("spring of {:.0f} N/m: ", stiffness);
        below({"D01", "MFIX 1.4e-4 to 3.6e-3"}, name + "position at 0.3 and 0.5 s, m", 5e-4, off.position);
        below({"D01", "MFIX 2.8e-3 to 2e-2"}, name + "velocity at 0.3 and 0.5 s, m/s", 5e-3, off.velocity);
        below("D01", name + "largest overlap, share off", 1e-3, off.overlap);
        below("D01", name + "duration of the contact, share off", 1e-2, off.duration);
        below("D01", name + "velocity at the end of the contact, share off", 2e-3, off.rebound);
    }
}

TEST(LinearSpring, bounces_to_the_heights_of_hard_spheres_the_nearer_the_stiffer_it_is)
{
    scene::Table const table("dem-02.csv");
    std::map<double, double> largest;
    std::map<std::pair<double, double>, std::vector<double>> heights;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const stiffness = table.number(row, "kn_N_per_m"), e = table.number(row, "e");
        auto const bounce = static_cast<std::size_t>(table.number(row, "bounce"));
        if (bounce == 0) continue;
        auto& tops = heights[{stiffness, e}];
        if (tops.empty()) {
            auto const simulation = dropped(stiffness, e, 5e-5);
            auto const& velocity = simulation->granules().velocity[0].z;
            for (double before = 0; tops.size() < 6; before = velocity) {
                simulation->step(5e-5);
                if (before > 0 && velocity <= 0) tops.push_back(simulation->granules().position[0].z);
            }
        }
        auto& off = largest[stiffness];
        off = std::max(off, std::abs(tops[bounce - 1] / table.number(row, "h_hard_sphere_m") - 1));
    }
    std::map<double, double> const published{{5e4, 0.085}, {5e5, 0.032}, {5e6, 0.011}};
    double before = 1;
    for (auto const& [stiffness, off] : largest) {
        double const limit = published.at(stiffness);
        below({"D02", fmt::format("MFIX {:.2g} %", 100 * limit).c_str()},
              fmt::format("spring of {:.0e} N/m: six heights for four restitutions, largest share off", stiffness),
              limit, off);
        EXPECT_LT(off, before) << "stiffer, and not nearer";
        before = off;
    }
}

TEST(LinearSpring, turns_sliding_into_rolling_at_two_sevenths)
{
    double const radius = 5e-4, speed = 0.1, g = 9.80665, step = 1e-6;
    double late = 0, moving = 0, turning = 0;
    for (double const friction : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
        auto const simulation =
            simulate({.stuff = {1e9, 0.25, 1e4},
                      .pair = {.restitution = 1, .sliding_friction = friction, .rolling_friction = 0},
                      .granules = {{.position = {2e-3, 4e-3, radius}, .velocity = {speed, 0, 0}, .spin = {}}},
                      .radius = radius,
                      .step = step,
                      .size = {0.02, 8e-3, 8e-3},
                      .gravity = {0, 0, -g},
                      .contact = linear(1e4, 1.0)});
        auto const& granules = simulation->granules();
        while (granules.velocity[0].x - radius * granules.spin[0].y > 1e-4 * speed && simulation->time() < 0.1)
            simulation->step(step);
        late = std::max(late, std::abs(simulation->time() * friction * g / speed * 7 / 2 - 1));
        // Nothing damps the springs of a restitution of one: the mean over many of their periods.
        double velocity = 0, spin = 0;
        int const count = 4000;
        for (int k = 0; k < count; ++k) {
            simulation->step(step);
            velocity += granules.velocity[0].x / count, spin += granules.spin[0].y / count;
        }
        moving = std::max(moving, std::abs(velocity / speed * 7 / 5 - 1));
        turning = std::max(turning, std::abs(spin * radius / speed * 7 / 5 - 1));
    }
    below({"D03", "MFIX 0.04 to 0.57 %"}, "friction 0.2 to 1: end of sliding, largest share off", 0.01, late);
    below({"D03", "MFIX 5e-4 to 0.017 %"}, "friction 0.2 to 1: velocity then, largest share off", 1e-3, moving);
    below({"D03", "MFIX 1e-3 to 0.042 %"}, "friction 0.2 to 1: spin then, largest share off", 1e-3, turning);
}

TEST(LinearSpring, follows_the_course_of_a_head_on_collision)
{
    // A quarter of the speed of the reference, and so of its overlaps, which go beyond the radius: the law is linear.
    double const slower = 0.25, radius = 0.1, step = 1e-5;
    scene::Table const table("dem-12.csv");
    auto const simulation =
        simulate({.stuff = {1e7, 0.25, 2000},
                  .pair = {.restitution = 0.3, .sliding_friction = 0, .rolling_friction = 0},
                  .granules = {{.position = {1 - radius, 1, 1}, .velocity = {2 * slower, 0, 0}, .spin = {}},
                               {.position = {1 + radius, 1, 1}, .velocity = {-2 * slower, 0, 0}, .spin = {}}},
                  .radius = radius,
                  .step = step,
                  .size = {2, 2, 2},
                  .gravity = {},
                  .contact = linear(1185.3391)});
    auto const& granules = simulation->granules();
    double overlap = 0, velocity = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        while (simulation->time() < table.number(row, "t_s") - 0.5 * step) simulation->step(step);
        double const closing = std::abs(granules.position[0].x - granules.position[1].x);
        double const speed = (granules.velocity[0].x - granules.velocity[1].x) * (granules.id[0] == 0 ? 1 : -1);
        overlap = std::max(overlap, std::abs(2 * radius - closing - slower * table.number(row, "overlap_m")));
        velocity = std::max(velocity, std::abs(speed - slower * table.number(row, "relative_velocity_m_per_s")));
    }
    below({"D12", "YADE 0.01 %"}, "overlap, largest difference over the largest overlap", 1e-4,
          overlap / (slower * 0.1496218229));
    below({"D12", "YADE 0.01 %"}, "closing speed, largest difference over the first speed", 1e-4,
          velocity / (4 * slower));
}

TEST(LinearSpring, keeps_the_energy_of_an_elastic_gas)
{
    double const size = 0.08, radius = 0.005, stiffness = 1000, energy = 738.15e-7, step = 2e-5;
    Scenario scenario{.stuff = {1e6, 0.25, 1000},
                      .pair = {.restitution = 1, .sliding_friction = 0, .rolling_friction = 0},
                      .granules = {},
                      .radius = radius,
                      .step = step,
                      .size = {size, size, size},
                      .gravity = {},
                      .contact = linear(stiffness),
                      .apparatus = "periodic = [\"x\", \"y\", \"z\"]"};
    double square = 0;
    for (int k = 0; k < 195; ++k) {
        base::Random random(2, base::Purpose::test, static_cast<std::uint64_t>(k), 0);
        double const spacing = size / 6;
        Vec3 const at{(k % 6 + 0.5) * spacing, (k / 6 % 6 + 0.5) * spacing, (k / 36 + 0.5) * spacing};
        Vec3 const velocity{random.normal(), random.normal(), random.normal()};
        square += norm2(velocity);
        scenario.granules.push_back({.position = at, .velocity = velocity, .spin = {}});
    }
    double const mass = mass_of(scenario.stuff, radius);
    for (auto& granule : scenario.granules) granule.velocity *= std::sqrt(2 * energy / mass / square);
    auto const simulation = simulate(scenario);
    double farthest = 0, least = energy;
    while (simulation->time() < 5) {
        for (int k = 0; k < 500; ++k) simulation->step(step);
        double kinetic = 0, elastic = 0;
        auto const& granules = simulation->granules();
        for (std::size_t row = 0; row < granules.owned; ++row) kinetic += 0.5 * mass * norm2(granules.velocity[row]);
        std::map<std::pair<particle::Id, particle::Id>, double> overlaps;  // over a periodic side both partners see it
        for (auto const& contact : simulation->engine().contacts())
            overlaps[{contact.low, contact.high}] = contact.overlap;
        for (auto const& [pair, overlap] : overlaps) elastic += 0.5 * stiffness * overlap * overlap;
        farthest = std::max(farthest, std::abs((kinetic + elastic) / energy - 1));
        least = std::min(least, kinetic);
    }
    below({"D11", "MFIX 0.01 %"}, "elastic gas over 5 s: kinetic and elastic energy, largest share off", 1e-4,
          farthest);
    below({"D11", "MFIX 2.2 %"}, "elastic gas over 5 s: largest share of the energy in overlaps", 0.05,
          1 - least / energy);
}
}
