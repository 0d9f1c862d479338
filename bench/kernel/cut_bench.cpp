// Time to cut a grid of 40 x 40 x 160 cells: open volumes and the open areas of all faces, thin walls looked for.
#include "granum/geometry/open_part.hpp"
#include "granum/geometry/region.hpp"
#include "scene/closed_meshes.hpp"

#include <benchmark/benchmark.h>

#include <array>

namespace
{
using namespace granum;
using geometry::Region;
using math::Vec3;

Vec3 const up{0, 0, 1};
std::vector<geometry::ProfilePoint> const profile{{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}};

//! A cone with a cylinder on it, 49,800 facets.
std::vector<geometry::Triangle> chamber_surface()
{
    std::vector<geometry::ProfilePoint> outline{{0, 0}};
    for (int k = 0; k <= 124; ++k) {
        double const z = k / 124.0;
        outline.push_back({z, z < 0.45 ? 0.09 + 0.035 * z / 0.45 : 0.125});
    }
    outline.push_back({1, 0});
    return scene::turned_surface(outline, 200);
}

//! A tube of sheet metal, 1 mm thick, 48,000 facets.
std::vector<geometry::Triangle> tube_surface()
{
    auto const flank = [](double radius) { return scene::cylinder_mesh(radius, 0, 0.2, 200).triangles; };
    std::vector<geometry::Triangle> out;
    for (int k = 0; k < 60; ++k) {
        double const low = 0.02 + 0.2 * k / 60, high = 0.02 + 0.2 * (k + 1) / 60;
        for (auto triangle : flank(0.05)) {
            for (auto& corner : triangle) corner.z = corner.z == 0 ? low : high;
            out.push_back(triangle);
        }
        for (auto triangle : flank(0.049)) {
            for (auto& corner : triangle) corner.z = corner.z == 0 ? low : high;
            std::swap(triangle[1], triangle[2]);
            out.push_back(triangle);
        }
    }
    // The rings at both ends.
    for (double const z : {0.02, 0.22})
        for (int k = 0; k < 200; ++k) {
            auto const at = [&](int step, double radius) {
                double const angle = 2 * math::pi * (step % 200) / 200;
                return Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
            };
            geometry::Triangle one{at(k, 0.049), at(k, 0.05), at(k + 1, 0.05)},
                two{at(k, 0.049), at(k + 1, 0.05), at(k + 1, 0.049)};
            if (z < 0.1) std::swap(one[1], one[2]), std::swap(two[1], two[2]);
            out.insert(out.end(), {one, two});
        }
    return out;
}

void cut(benchmark::State& state, Region const& region)
{
    std::array<int, 3> const n{40, 40, 160};
    Vec3 const low{-0.125, -0.125, 0}, step{0.25 / n[0], 0.25 / n[1], 1.0 / n[2]};
    for (auto _ : state) {
        double sum = 0;
        for (int k = 0; k < n[2]; ++k)
            for (int j = 0; j < n[1]; ++j)
                for (int i = 0; i < n[0]; ++i) {
                    Vec3 const a = low + Vec3{i * step.x, j * step.y, k * step.z}, b = a + step;
                    sum += geometry::open_volume(region, a, b);
                    std::array const at{i, j, k};
                    for (std::size_t d = 0; d < 3; ++d)
                        sum +=
                            geometry::open_area(region, static_cast<int>(d), a, b, {at[d] > 0 ? step[d] : 0, step[d]});
                }
        benchmark::DoNotOptimize(sum);
    }
}

Region tower()
{
    return Region("chamber", geometry::Chamber{.shape = geometry::Chamber::Shape::revolution, .profile = profile});
}

void chamber_alone(benchmark::State& state)
{
    cut(state, tower());
}
void turned_with_tube_and_nozzle(benchmark::State& state)
{
    cut(state, Region("chamber", geometry::turned(profile)) -
                   Region("tube", geometry::tube({0, 0, 0.02}, up, 0.2, 0.049, 0.05)) -
                   Region("nozzle", geometry::cylinder({0, 0, -0.01}, up, 0.03, 0.015)));
}
void stl_chamber(benchmark::State& state)
{
    cut(state, Region("chamber", scene::closed(chamber_surface())));
}
void stl_tube_in_chamber(benchmark::State& state)
{
    cut(state, tower() - Region("tube", scene::closed(tube_surface())));
}

BENCHMARK(chamber_alone)->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK(turned_with_tube_and_nozzle)->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK(stl_chamber)->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK(stl_tube_in_chamber)->Unit(benchmark::kSecond)->Iterations(1);
}

BENCHMARK_MAIN();
