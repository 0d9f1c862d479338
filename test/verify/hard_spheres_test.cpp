// The rows of hard spheres beside those of soft ones, each stated as a case with contact.engine = "hard" and moved by
// the step of `granum run`: impacts, a bouncing and a sliding sphere, gases that keep their energy or cool after Haff.
// Left out is what only soft contacts have: forces, overlaps, durations, and rebounds that stick and spring back.
#include "scene/case_text.hpp"
#include "scene/hard_granules.hpp"
#include "scene/reference.hpp"
#include "table.hpp"

namespace
{
using namespace granum;
using namespace verify;
using math::Vec3;

struct Pair
{
    double restitution, friction, tangential = 0.33;
};

std::unique_ptr<sim::Simulation> simulate(Vec3 const& size, Vec3 const& gravity, double radius, double density,
                                          Pair const& pair, std::string const& more, std::string const& granules = "")
{
    std::string text = "gravity = " + scene::vector_text(gravity, "m/s2");
    text += "\n[apparatus]\nshape = \"box\"\nsize = " + scene::vector_text(size, "m");
    text += granules.empty() ? "" : "\nperiodic = [\"x\", \"y\", \"z\"]";
    text += fmt::format("\n[granules]\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\n", 2 * radius, density);
    text += granules.empty() ? "" : "file = \"granules.csv\"\n";
    text += fmt::format(
        "[contact]\nengine = \"hard\"\nrestitution = {}\nsliding_friction = {}\ntangential_restitution = {}\n",
        pair.restitution, pair.friction, pair.tangential);
    return scene::simulation_of(text + "[time]\nduration = \"1000 s\"\n" + more, granules);
}

void run_to(sim::Simulation& simulation, double time)
{
    while (simulation.time() < time * (1 - 1e-12)) simulation.step(time - simulation.time());
}

struct Rebound
{
    Vec3 velocity, spin;
    double slip;  //!< of the point of contact along x, m/s
};

//! A sphere two radii above the plate that arrives with `velocity`, without gravity.
Rebound rebound(double radius, Vec3 const& velocity, Pair const& pair, Vec3 const& spin = {})
{
    double const edge = 40 * radius, fall = radius / -velocity.z;
    auto const simulation = simulate(
        {edge, edge, edge}, {}, radius, 4000, pair,
        scene::granule_text({.position = {edge / 2, edge / 2, 2 * radius}, .velocity = velocity, .spin = spin}));
    run_to(*simulation, 1.5 * fall);
    EXPECT_EQ(simulation->mover().hard_watch()->wall_collisions, 1);
    auto const& granules = simulation->granules();
    return {granules.velocity[0], granules.spin[0], granules.velocity[0].x - radius * granules.spin[0].y};
}

Rebound oblique(double degrees, Pair const& pair)
{
    double const angle = degrees * math::pi / 180;
    return rebound(2.5e-3, {3.9 * std::sin(angle), 0, -3.9 * std::cos(angle)}, pair);
}

double degrees_of(double radians)
{
    return radians * 180 / math::pi;
}

//! Mean difference over mean.
struct Apart
{
    double sum = 0, all = 0;
    void add(double reference, double ours) { sum += std::abs(ours - reference), all += std::abs(reference); }
    double share() const { return sum / all; }
};

TEST(HardImpacts, return_the_restitution_that_was_asked_for)
{
    double off = 0;
    for (double const e : {0.2, 0.4, 0.6, 0.8, 0.98, 1.0})
        off = std::max(off, std::abs(rebound(2.5e-3, {0, 0, -3.9}, {e, 0}).velocity.z / 3.9 / e - 1));
    below("P3", "hard sphere, restitution 0.2 to 1: largest share off", 5e-3, off);
}

TEST(HardImpacts, that_slide_are_those_of_rigid_bodies)
{
    for (double const degrees : {40.0, 60.0})
        relative("P4", fmt::format("hard sphere, oblique at {} deg: tangential restitution", degrees),
                 degrees == 40 ? 0.7829 : 0.8948,
                 oblique(degrees, {0.98, 0.092}).velocity.x / (3.9 * std::sin(degrees * math::pi / 180)), 1e-3);
    auto const spun = rebound(0.1, {0, 0, -0.2}, {0.5, 0.4, 0}, {0, -21, 0});
    relative("P7", "hard sphere with 21 rad/s: tangential velocity after, m/s", -0.12, spun.velocity.x, 1e-3);
    relative("P7", "hard sphere with 21 rad/s: spin after, rad/s", 18, -spun.spin.y, 1e-3);
}

TEST(HardImpacts, leave_as_the_measured_spheres_do)
{
    scene::Table const table("dem-04.csv");
    double angle = 0, kept = 0, spin = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const at = table.number(row, "impact_angle_deg"), expected = table.number(row, "value");
        if (table.text(row, "dataset") != "experiment" || at < 15) continue;
        auto const seen = oblique(at, {0.98, 0.092});
        auto const quantity = table.text(row, "quantity");
        if (quantity == "rebound_angle_deg")
            angle = std::max(angle, std::abs(degrees_of(std::atan2(seen.velocity.x, seen.velocity.z)) - expected));
        else if (quantity == "tangential_restitution")
            kept = std::max(kept, std::abs(seen.velocity.x / (3.9 * std::sin(at * math::pi / 180)) - expected));
        else
            spin = std::max(spin, std::abs(seen.spin.y / expected - 1));
    }
    below({"D04", "MFIX, Lethe: 1 deg"}, "hard sphere, 20 to 60 deg, measured: rebound angle, largest difference, deg",
          1.5, angle);
    below({"D04", "MFIX, Lethe: in the scatter"},
          "hard sphere, 20 to 60 deg, measured: tangential restitution, largest difference", 0.03, kept);
    below({"D04", "MFIX, Lethe: 10 %"}, "hard sphere, 20 to 60 deg, measured: spin, largest share off", 0.10, spin);
}

TEST(HardImpacts, follow_the_published_curves_where_they_slide)
{
    scene::Table const table("dem-07.csv");
    Apart kept, spin, angle;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const at = table.number(row, "impact_angle_deg");
        if (at < 30) continue;
        auto const seen = oblique(at, {0.98, 0.092});
        kept.add(table.number(row, "tangential_restitution"), seen.velocity.x / (3.9 * std::sin(at * math::pi / 180)));
        spin.add(table.number(row, "spin_rad_per_s"), -seen.spin.y);
        angle.add(table.number(row, "contact_point_rebound_angle_deg"),
                  degrees_of(std::atan2(seen.slip, seen.velocity.z)));
    }
    below({"D07", "Kratos 1.6 %"}, "hard sphere, 30 to 85 deg: tangential restitution, mean difference over mean",
          0.016, kept.share());
    below({"D07", "Kratos 2.2 %"}, "hard sphere, 30 to 85 deg: spin, mean difference over mean", 0.022, spin.share());
    below({"D07", "Kratos 2.5 %"},
          "hard sphere, 30 to 85 deg: rebound angle of the contact point, mean difference over mean", 0.025,
          angle.share());
}

TEST(HardImpacts, of_spinning_spheres_recoil_as_published_where_they_slide)
{
    double const speed = 0.2, mu = 0.4, e = 0.5, gross = 3.5 * mu * (1 + e);
    scene::Table const table("dem-08.csv");
    double farthest = 0;
    Apart recoil;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        bool const beta = table.text(row, "quantity") == "beta";
        double const x = table.number(row, "x"), y = table.number(row, "y");
        if (beta ? x >= 1 : x <= gross) continue;  // these stick
        double const slip = beta ? gross * speed / x : x * speed;
        auto const seen = rebound(0.1, {0, 0, -speed}, {e, mu, 0}, {0, -slip / 0.1, 0});
        if (beta)
            farthest = std::max(farthest, std::abs(-seen.slip / slip - y));
        else
            recoil.add(y, seen.slip / seen.velocity.z);
    }
    below({"D08", "Kratos 0.03"}, "hard sphere, sliding: share of the slip kept, largest difference", 0.03, farthest);
    below({"D08", "Kratos 3 %"}, "hard sphere, sliding: tangent of the recoil angle, mean difference over mean", 0.03,
          recoil.share());
}

TEST(HardSphere, bounces_to_the_heights_of_the_closed_form)
{
    scene::Table const table("dem-02.csv");
    double off = 0;
    for (double const e : {1.0, 0.9, 0.7, 0.5}) {
        auto const simulation =
            simulate({2, 2, 2}, {0, 0, -9.80665}, 0.1, 2600, {e, 0}, scene::granule_text({.position = {1, 1, 0.5}}));
        auto const& granules = simulation->granules();
        std::vector<double> tops{0.5};
        for (double before = 0; tops.size() < 7; before = granules.velocity[0].z) {
            run_to(*simulation, simulation->time() + 5e-5);
            if (before > 0 && granules.velocity[0].z <= 0) tops.push_back(granules.position[0].z);
        }
        for (std::size_t row = 0; row < table.rows(); ++row)
            if (table.number(row, "e") == e)
                off = std::max(off, std::abs(tops[static_cast<std::size_t>(table.number(row, "bounce"))] /
                                                 table.number(row, "h_hard_sphere_m") -
                                             1));
    }
    below({"D02", "MFIX 1.1 % and more"}, "hard sphere: six heights for four restitutions, largest share off", 1e-4,
          off);
}

TEST(HardSphere, turns_sliding_into_rolling_at_two_sevenths)
{
    double const radius = 5e-4, speed = 0.1, g = 9.80665;
    double late = 0, moving = 0, turning = 0;
    for (double const friction : {0.2, 0.6, 1.0}) {
        auto const simulation =
            simulate({0.02, 8e-3, 8e-3}, {0, 0, -g}, radius, 1e4, {0.5, friction},
                     scene::granule_text({.position = {2e-3, 4e-3, radius}, .velocity = {speed, 0, 0}}));
        auto const& granules = simulation->granules();
        while (granules.velocity[0].x - radius * granules.spin[0].y > 1e-4 * speed && simulation->time() < 0.1)
            run_to(*simulation, simulation->time() + 1e-5);
        late = std::max(late, std::abs(simulation->time() * friction * g / speed * 7 / 2 - 1));
        moving = std::max(moving, std::abs(granules.velocity[0].x / speed * 7 / 5 - 1));
        turning = std::max(turning, std::abs(granules.spin[0].y * radius / speed * 7 / 5 - 1));
    }
    differs("D03", "hard sphere, friction 0.2 to 1: end of sliding, largest share off", 0.1, late,
            "it hops by 1e-4 of its radius");
    below({"D03", "MFIX 5e-4 to 0.017 %"}, "hard sphere, friction 0.2 to 1: velocity then, largest share off", 1e-3,
          moving);
    below({"D03", "MFIX 1e-3 to 0.042 %"}, "hard sphere, friction 0.2 to 1: spin then, largest share off", 1e-3,
          turning);
}

//! The granules as they are, in a periodic cube.
std::unique_ptr<sim::Simulation> gas_of(particle::Store const& granules, double size, double restitution)
{
    std::string rows = "id,x,y,z,radius,vx,vy,vz\n";
    for (std::size_t k = 0; k < granules.owned; ++k) {
        auto const &p = granules.position[k], &v = granules.velocity[k];
        rows += fmt::format("{},{},{},{},{},{},{},{}\n", k, p.x, p.y, p.z, granules.radius[k], v.x, v.y, v.z);
    }
    return simulate({size, size, size}, {}, granules.radius[0], 1000, {restitution, 0}, "", rows);
}

double temperature(sim::Simulation& simulation)
{
    auto const& granules = simulation.granules();
    double sum = 0;
    for (std::size_t k = 0; k < granules.owned; ++k) sum += norm2(granules.velocity[k]);
    return sum / (3 * static_cast<double>(granules.owned));
}

//! Momentum over the sum of the speeds, equal masses.
double common_motion(particle::Store const& granules, double speeds)
{
    Vec3 sum;
    for (std::size_t k = 0; k < granules.owned; ++k) sum += granules.velocity[k];
    return norm(sum) / speeds;
}

// A gas of 5 % solids and 0.01 m2/s2 that has forgotten its lattice, with restitution 0.9 from now on.
std::unique_ptr<sim::Simulation> mixed(int side, std::uint32_t seed)
{
    auto const lattice = scene::hard_gas(side, 0.05, 0.01, {}, seed);
    double const size = lattice.settings.upper.x;
    auto const elastic = gas_of(lattice.granules, size, 1);
    run_to(*elastic, 0.1);
    return gas_of(elastic->granules(), size, 0.9);
}

TEST(HardGas, of_another_code_keeps_its_energy)
{
    // 195 spheres in a periodic box of 8 cm with 738.15 erg, 5 s.
    auto gas = scene::hard_gas(6, 0.2, 4.742e-4, {}, 11);
    auto& granules = gas.granules;
    double const edge = gas.settings.upper.x, wanted = 738.15e-7, mass = 1000 * 4.0 / 3 * math::pi * 1.25e-7;
    granules.resize(195);
    granules.owned = 195;
    double square = 0;
    for (std::size_t k = 0; k < 195; ++k) square += norm2(granules.velocity[k]);
    for (std::size_t k = 0; k < 195; ++k) {
        granules.position[k] *= 0.08 / edge;
        granules.velocity[k] *= std::sqrt(2 * wanted / mass / square);
        granules.radius[k] = 0.005;
    }
    auto const simulation = gas_of(granules, 0.08, 1);
    double off = 0;
    for (int k = 1; k <= 10; ++k) {
        run_to(*simulation, 0.5 * k);
        off = std::max(off, std::abs(1.5 * 195 * mass * temperature(*simulation) / wanted - 1));
    }
    below({"D11", "MFIX 0.01 %"}, "hard spheres over 5 s: kinetic energy, largest share off", 1e-4, off);
}

TEST(HardGas, starts_to_cool_at_the_rate_of_haff)
{
    double mean = 0;
    int const seeds = 5;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        auto const simulation = mixed(13, seed);
        double const before = temperature(*simulation);
        run_to(*simulation, 0.02);
        mean += 2 * (std::sqrt(before / temperature(*simulation)) - 1) / 0.02 / seeds;
    }
    relative("P10", "hard spheres, 0.05 solids, restitution 0.9: initial -d ln T/dt, mean of 5 seeds, 1/s", 4.876, mean,
             0.10);
}

TEST(HardGas, follows_the_law_of_haff_over_a_million_collisions)
{
    auto const simulation = mixed(22, 1);
    auto const& granules = simulation->granules();
    double const start = temperature(*simulation);
    double const tau = 2 / (4.8761 * std::sqrt(start / 0.01));
    double speeds = 0;
    for (std::size_t k = 0; k < granules.owned; ++k) speeds += norm(granules.velocity[k]);
    double const before = common_motion(granules, speeds);
    for (double const at : {1.0, 5.0, 20.0, 100.0}) {
        run_to(*simulation, at * tau);
        relative("D10",
                 fmt::format("{} hard spheres: temperature at {} tau over that at the start", granules.owned, at),
                 1 / std::pow(1 + at, 2), temperature(*simulation) / start, 0.05);
    }
    auto const& seen = *simulation->mover().hard_watch();
    while (seen.collisions < 1'000'000) run_to(*simulation, simulation->time() + 20 * tau);
    below("D10", "hard spheres, a million collisions: largest overlap over a radius", 1e-9, seen.largest_overlap);
    below("D10", "hard spheres, a million collisions: change of the momentum over the sum of all at the start", 1e-12,
          std::abs(common_motion(granules, speeds) - before));
}
}
