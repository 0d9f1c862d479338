// The angle of the surface in a rotating drum: without ends against the published range, and between ends that turn
// with it against LAMMPS (drum.lammps).
//
// Drum, spheres and frictions are those with which the code Lethe was matched to a measured angle of 26 degrees
// (examples/dem/3d-rotating-drum-calibration of the repository chaos-polymtl/lethe, rotating-drum.prm and README.md;
// El Geitani and Blais, "Solid-liquid rotary kilns: An experimental and CFD-DEM study", Powder Technol. 2023), and the
// angle is taken as there: a line through the mean height of the ten highest spheres in each of eight columns.
#include "scene/drum.hpp"
#include "bed.hpp"

#include <numeric>

namespace
{
using namespace granum;
using namespace validate;

constexpr double drum_radius = 0.069, length = 0.045, rate = 2.198, radius = 0.002975, density = 1768;
constexpr std::size_t spheres = 1459;  // 6000 in a drum of 0.185 m
constexpr double dt = 4e-5, start = 0.4, steady = 2.4, stop = 5.4;

//! A slice of a long drum, or a short drum whose ends turn with it.
Scene drum_with(double friction, double rolling, bool ends)
{
    double const share = spheres * 4.0 / 3.0 * std::pow(radius, 3) / (0.58 * drum_radius * drum_radius * length);
    auto scene = scene::filled_drum({drum_radius, length, rate, start}, {2.4e6, 0.37, density},
                                    {.restitution = 0.9, .sliding_friction = friction, .rolling_friction = rolling},
                                    radius, share);
    scene.granules.resize(spheres);
    scene.granules.owned = spheres;
    if (ends) {
        scene.settings.periodic = {};
        auto& drum = scene.settings.walls.front();
        for (double const y : {0.0, length})
            drum.shapes.push_back(geometry::Disc{.centre = {0, y, 0}, .normal = {0, 1, 0}, .radius = drum_radius});
    }
    scene.prepare();
    return scene;
}

//! Mean height of the ten highest spheres in columns of 6 mm around each of `places`, m.
std::vector<double> surface(Scene const& scene, std::vector<double> const& places)
{
    std::vector<double> out;
    for (double const place : places) {
        std::vector<double> heights;
        for (std::size_t row = 0; row < scene.granules.owned; ++row) {
            Vec3 const& at = scene.granules.position[row];
            if (std::abs(at.x - place) < 0.003) heights.push_back(at.z);
        }
        EXPECT_GE(heights.size(), 10u);
        std::partial_sort(heights.begin(), heights.begin() + 10, heights.end(), std::greater<>{});
        out.push_back(std::accumulate(heights.begin(), heights.begin() + 10, 0.0) / 10);
    }
    return out;
}

//! Angle of the surface, mean over three seconds (without ends the bed slips and grips again about once a second), deg.
double angle(double friction, double rolling, bool ends, Section* section = nullptr)
{
    auto scene = drum_with(friction, rolling, ends);
    scene.run(std::lround(steady / dt), dt);
    std::vector<double> places, heights(8, 0.0);
    for (int k = 0; k < 8; ++k) places.push_back((-0.5 + k / 7.0) * drum_radius);
    int const looks = static_cast<int>(std::lround((stop - steady) / 0.02));
    for (int look = 0; look < looks; ++look) {
        scene.run(std::lround(0.02 / dt), dt);
        auto const now = surface(scene, places);
        for (std::size_t k = 0; k < 8; ++k) heights[k] += now[k] / looks;
    }
    if (section) {
        auto shown = snapshot_of(scene, {}, 0);
        for (int k = 0; k < 90; ++k)
            shown.outline.push_back(
                {drum_radius * std::cos(2 * math::pi * k / 90), drum_radius * std::sin(2 * math::pi * k / 90)});
        section->picture("drum", shown, speeds(scene), {0, 2 * rate * drum_radius},
                         "The drum with ends, seen through one; colour: speed, 0 to twice that of the drum");
    }
    return std::abs(std::atan(slope(places, heights))) * 180 / math::pi;
}

TEST(RotatingDrum, keeps_its_surface_at_the_published_angle)
{
    Section section(
        "Rotating drum",
        "1459 spheres of 5.95 mm in a drum of 138 mm that turns with 21 rpm, Froude number 0.034 (rolling regime): a "
        "slice of 45 mm\nof a long drum, or 45 mm between ends that turn with it. Sliding friction 0.3 and rolling "
        "friction 0.02, with which another code was\nmatched to 26 deg measured in such a drum of 185 mm between ends "
        "of unknown friction; restitution 0.9, Young's modulus 2.4 MPa.\nThe angle is the mean of three seconds. "
        "LAMMPS, with the same laws, ran `test/validate/drum.lammps`.");
    section.between("between ends: angle, deg", 33.9, 36.9, "LAMMPS: 35.4", angle(0.3, 0.02, true, &section));
    std::vector<double> sliding, rolling;
    for (double const friction : {0.1, 0.3, 0.6}) sliding.push_back(angle(friction, 0.02, false));
    for (double const friction : {0.0, 0.02, 0.2})
        rolling.push_back(friction == 0.02 ? sliding[1] : angle(0.3, friction, false));
    section.between("without ends: angle, deg", 20, 28, "spheres with little resistance to rolling, recalled [R]",
                    sliding[1]);
    section.rising("without ends, sliding friction 0.1, 0.3, 0.6: angle, deg", "recalled [R]", sliding);
    section.rising("without ends, rolling friction 0, 0.02, 0.2: angle, deg", "recalled [R]", rolling);
}
}
