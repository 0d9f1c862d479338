// Discharge of a silo with a flat bottom through a round hole, against Beverloo, Leniger and van de Velde, Chem. Eng.
// Sci. 15 (1961) 260 [R]: W = C rho_b sqrt(g) (D - k d)^2.5, C 0.55 to 0.65, k about 1.4 for spheres, for holes above
// 6 d and below 0.4 of the silo (reference case dem-13). The power is the criterion, the coefficients are looked at.
#include "bed.hpp"

namespace
{
using namespace granum;
using namespace validate;

constexpr double radius = 1e-3, diameter = 2 * radius, density = 2500, dt = 2e-5, g = 9.81;
constexpr double silo = 20 * diameter;  //!< its width, m
constexpr std::size_t spheres = 9000;

geometry::Body floor_with(double hole)
{
    return {.name = "floor", .shapes = {geometry::Disc{.radius = silo / 2, .hole = hole / 2}}, .material = 1};
}

//! Spheres at rest in the closed silo.
Scene filled()
{
    Scene scene({2e6, 0.25, density}, {.restitution = 0.5, .sliding_friction = 0.3});
    scene.settings.gravity = {0, 0, -g};
    scene.settings.lower = {-silo / 2, -silo / 2, -0.1};
    scene.settings.upper = {silo / 2, silo / 2, 3 * silo};
    scene.slabs = {.origin = -silo / 2, .width = silo};
    scene.settings.walls.push_back({.name = "silo",
                                    .shapes = {geometry::Frustum{.base = {0, 0, -0.1},
                                                                 .length = 3 * silo + 0.1,
                                                                 .base_radius = silo / 2,
                                                                 .top_radius = silo / 2,
                                                                 .side = geometry::Side::inside}},
                                    .material = 1});
    scene.settings.walls.push_back(floor_with(0));
    double const spacing = 1.12 * diameter;
    for (int k = 0; scene.granules.rows() < spheres; ++k)
        for (int j = -9; j <= 9; ++j)
            for (int i = -9; i <= 9; ++i) {
                Vec3 const at{i * spacing, j * spacing, (k + 0.6) * spacing};
                if (std::hypot(at.x, at.y) > silo / 2 - 1.02 * radius) continue;
                base::Random random(5, base::Purpose::test, scene.granules.rows(), 0);
                scene.add(at, 0.15 * Vec3{random.normal(), random.normal(), random.normal()}, radius, density);
            }
    scene.prepare();
    settle(scene, dt, 10'000, 20'000);
    return scene;
}

//! Rate of 1200 spheres through the hole after the first 300, kg/s.
double discharge(Scene const& full, double hole, Section* section = nullptr)
{
    Scene scene({2e6, 0.25, density});
    scene.settings = full.settings;
    scene.granules = full.granules;
    scene.slabs = full.slabs;
    scene.settings.walls[1] = floor_with(hole);
    scene.prepare();
    double const mass = scene.granules.mass[0];
    long out = 0, out_first = 0, step = 0, step_first = 0;
    while (out < 1500 && step < 200'000) {
        scene.run(50, dt), step += 50;
        out += remove(scene, [](Vec3 const& at) { return at.z < -1.5 * radius; });
        if (step_first == 0 && out >= 300) step_first = step, out_first = out;
    }
    if (section) {
        double const height = 1.4 * silo;
        section->picture(
            "hopper", snapshot_of(scene, {{-silo / 2, 0}, {silo / 2, 0}, {silo / 2, height}, {-silo / 2, height}}, 0),
            speeds(scene), {0, 0.3},
            fmt::format("Silo with a hole of {:.3g} diameters, cut; colour: speed, 0 to 0.3 m/s", hole / diameter));
    }
    return static_cast<double>(out - out_first) * mass / (static_cast<double>(step - step_first) * dt);
}

//! C of a rate with a given k.
double coefficient(double rate, double bulk, double width)
{
    return rate / (bulk * std::sqrt(g) * std::pow(width, 2.5));
}

TEST(Hopper, discharges_with_the_power_five_halves_of_the_free_width_of_the_hole)
{
    Section section(
        "Hopper discharge",
        "9000 spheres of 2 mm in a silo with a flat bottom, 20 diameters wide and filled as high as wide; rate of 1200 "
        "spheres after\nthe first 300. Friction 0.3, restitution 0.5, Young's modulus 2 MPa. W: rate, rho_b: bulk "
        "density at rest, D: hole, d: sphere. W is\nW = C rho_b sqrt(g) (D - k d)^2.5 with one C and one k for all "
        "holes; where k is taken as 1.4, C is just below its range.");
    std::string const source = "Beverloo et al. 1961 [R] (dem-13)";
    Scene const full = filled();
    double const bulk = density * solids_between(full, 2 * diameter, 12 * diameter, math::pi / 4 * silo * silo);
    section.tells("solids at rest", bulk / density);
    std::vector<double> holes, roots, widths, rates;
    for (double const share : {6.0, 6.6, 7.3, 8.0}) {
        double const hole = share * diameter, width = hole - 1.4 * diameter;
        double const rate = discharge(full, hole, share == 8.0 ? &section : nullptr);
        section.tells(fmt::format("D = {} d: W, kg/s", share), rate);
        section.tells(fmt::format("D = {} d: C with k = 1.4", share), coefficient(rate, bulk, width));
        holes.push_back(hole), roots.push_back(std::pow(rate, 0.4));
        widths.push_back(std::log(width)), rates.push_back(std::log(rate));
    }
    section.between("exponent of D - 1.4 d", 2.4, 2.6, source, slope(widths, rates));
    // W^0.4 = a (D - k d), a^2.5 = C rho_b sqrt(g).
    double const a = slope(holes, roots);
    section.between("k where the line through W^0.4 is 0", 1.2, 3, "recalled [R]",
                    (mean(holes) - mean(roots) / a) / diameter);
    section.between("C of that line", 0.55, 0.65, source, coefficient(std::pow(a, 2.5), bulk, 1));
}
}
