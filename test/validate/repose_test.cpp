// The angle that a heap keeps when the bed on a plate runs off over both edges of the plate, against the correlation of
// Zhou, Xu, Yu and Zulli, Powder Technol. 125 (2002) 45, as the code Lethe cites it (dem-14), and the trends in the
// abstract of Zhou et al., Phys. Rev. E 64 (2001) 021301: steeper with both frictions and in a thinner container.
#include "bed.hpp"
#include "scene/reference.hpp"

namespace
{
using namespace granum;
using namespace validate;

struct Heap
{
    double diameter;                             //!< m
    double friction, wall_friction;              //!< 1
    double rolling_length, wall_rolling_length;  //!< torque over normal force, m
    bool between_walls = false;                  //!< 4 diameters apart, instead of periodic sides 5 diameters apart
};

//! Slope of the heap's sides, mean of both, deg.
double repose(Heap const& s, Section* section = nullptr)
{
    double const d = s.diameter, radius = d / 2, length = 40 * d, depth = (s.between_walls ? 4 : 5) * d, density = 2500;
    double const g = 9.81, modulus = 2e4 * density * g * d;  // equally soft for every size
    // Our torque is limited by mu_r R* F: R* is a quarter of a diameter between spheres and half a one at a wall.
    Scene scene({modulus, 0.25, density},
                {.restitution = 0.5, .sliding_friction = s.friction, .rolling_friction = 4 * s.rolling_length / d});
    scene.settings.laws.pair(
        0, 1,
        {.restitution = 0.5, .sliding_friction = s.wall_friction, .rolling_friction = 2 * s.wall_rolling_length / d});
    scene.settings.gravity = {0, 0, -g};
    double const outlet = 4 * d, half = length / 2 + outlet;
    scene.settings.lower = {-length, 0, -d};
    scene.settings.upper = {length, depth, 40 * d};
    scene.settings.periodic = {false, !s.between_walls, false};
    scene.slabs = {.origin = -length, .width = 2 * length};
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    scene.add_plane({-half, 0, 0}, {1, 0, 0});
    scene.add_plane({half, 0, 0}, {-1, 0, 0});
    if (s.between_walls)
        for (double const y : {0.0, depth}) scene.add_plane({0, y, 0}, {0, y > 0 ? -1.0 : 1.0, 0});
    int const across = 40, deep = s.between_walls ? 3 : 4, high = s.between_walls ? 20 : 16;
    double const spacing = 2 * half / across;
    for (int k = 0; k < high; ++k)
        for (int j = 0; j < deep; ++j)
            for (int i = 0; i < across; ++i) {
                base::Random random(3, base::Purpose::test, scene.granules.rows(), 0);
                Vec3 const at{(i + 0.5) * spacing - half, (j + 0.5) * depth / deep, (k + 0.6) * spacing};
                Vec3 const speed = std::sqrt(g * d) * 0.5 * Vec3{random.normal(), random.normal(), random.normal()};
                scene.add(at, speed, radius, density);
            }
    // 1/20 of a contact at the speed of a fall by some diameters.
    double const mass = scene.granules.mass[0] / 2, speed = 3 * std::sqrt(g * d);
    double const dt = scene::hertz_time(modulus / (1 - 0.0625) / 2, radius / 2, mass, speed) / 20;
    scene.prepare();
    settle(scene, dt, 10'000, 20'000);

    // The floor beside the plate opens: what reaches it there is gone.
    auto const beyond = [length, radius](Vec3 const& at) { return std::abs(at.x) > length / 2 && at.z < 1.1 * radius; };
    long left = 0;
    for (int round = 0, quiet = 0; round < 1200 && quiet < 40; ++round) {
        scene.run(100, dt);
        long const now = remove(scene, beyond);
        left += now;
        quiet = now == 0 ? quiet + 1 : 0;
    }
    EXPECT_GT(left, 200) << "nothing ran off: the bed was too low";

    // The highest granule of every column, fitted by a line between a tenth and nine tenths of each side.
    int const columns = 40;
    std::vector<double> top(columns, 0);
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        Vec3 const& at = scene.granules.position[row];
        int const column = std::clamp(static_cast<int>((at.x / length + 0.5) * columns), 0, columns - 1);
        auto& highest = top[static_cast<std::size_t>(column)];
        highest = std::max(highest, at.z + radius);
    }
    double rise = 0;
    for (int const side : {-1, 1}) {
        std::vector<double> x, z;
        for (int column = 2; column < columns / 2 - 2; ++column) {
            x.push_back((column + 0.5) * length / columns);
            z.push_back(top[static_cast<std::size_t>(side < 0 ? column : columns - 1 - column)]);
        }
        rise += 0.5 * slope(x, z);
    }
    if (section) {
        double const height = 1.3 * *std::max_element(top.begin(), top.end());
        section->picture(
            "repose",
            snapshot_of(scene, {{-length / 2, 0}, {length / 2, 0}, {length / 2, height}, {-length / 2, height}}, 0),
            speeds(scene), {0, 0.05 * std::sqrt(g * d)},
            fmt::format(
                "Heap of {:.0f} mm spheres with friction {}, nothing leaves it any more; colour: speed, 0 to 11 mm/s",
                1e3 * d, s.friction));
    }
    return std::atan(rise) * 180 / math::pi;
}

TEST(AngleOfRepose, encloses_the_correlation_and_rises_with_both_frictions)
{
    Section section(
        "Angle of repose",
        "Some 2500 spheres on a plate of 40 diameters; outlets of 4 diameters beside it open and the bed runs off over "
        "both edges.\nThe angle is that of a line through the highest spheres. Side walls carry a part of the weight: "
        "the angle is given between\nperiodic sides and between walls 4 diameters apart, and the correlation, whose "
        "thickness is not known to us, has to lie\nbetween the two (reference case dem-14). Restitution 0.5, Young's "
        "modulus 20,000 times density, gravity and diameter.");
    scene::Table const table("dem-14.csv");
    double usual = 0;
    for (std::size_t const row : {0, 3}) {
        Heap heap{1e-3 * table.number(row, "d_mm"), table.number(row, "mu_s_pp"), table.number(row, "mu_s_pw"),
                  1e-3 * table.number(row, "mu_r_pp_mm"), 1e-3 * table.number(row, "mu_r_pw_mm")};
        auto const name =
            fmt::format("{:.0f} mm, friction {} and {} (walls), rolling {} and {} mm", 1e3 * heap.diameter,
                        heap.friction, heap.wall_friction, 1e3 * heap.rolling_length, 1e3 * heap.wall_rolling_length);
        usual = repose(heap, row == 3 ? &section : nullptr);
        heap.between_walls = true;
        section.encloses(name + ": angle, deg", table.number(row, "angle_deg"), 3, "Zhou et al. 2002 (dem-14)", usual,
                         repose(heap));
    }
    section.rising("friction 0.1, 0.4, 0.8 at 5 mm, rolling 0.05 mm: angle, deg", "Zhou et al. 2001, abstract",
                   {repose({5e-3, 0.1, 0.5, 5e-5, 5e-5}), usual, repose({5e-3, 0.8, 0.5, 5e-5, 5e-5})});
    section.rising("rolling 0, 0.05, 0.4 mm at 5 mm, friction 0.4: angle, deg", "Zhou et al. 2001, abstract",
                   {repose({5e-3, 0.4, 0.5, 0, 0}), usual, repose({5e-3, 0.4, 0.5, 4e-4, 4e-4})});
}
}
