// Walls thinner than a cell: nothing leaks through them, and nothing else is closed for their sake.
#include "granum/geometry/open_part.hpp"

#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace granum::geometry;
using namespace granum::scene;
using granum::math::pi;

namespace
{
Vec3 const up{0, 0, 1};

//! A uniform grid over a box; cells are joined by faces with an open area.
class Grid
{
  public:
    Grid(Region const& region, Vec3 const& low, Vec3 const& high, int n) : Grid(region, low, high, std::array{n, n, n})
    {
    }
    Grid(Region const& region, Vec3 const& low, Vec3 const& high, std::array<int, 3> n)
        : low_(low), step_{(high.x - low.x) / n[0], (high.y - low.y) / n[1], (high.z - low.z) / n[2]}, n_(n)
    {
        auto const cells = static_cast<std::size_t>(n[0] * n[1] * n[2]);
        for (auto& area : area_) area.assign(cells, 0);
        volume_.assign(cells, 0);
        each([&](int i, int j, int k) {
            Vec3 const a = corner(i, j, k), b = a + step_;
            volume_[at(i, j, k)] = open_volume(region, a, b);
            std::array const index{i, j, k};
            for (std::size_t d = 0; d < 3; ++d)
                if (index[d] > 0)
                    area_[d][at(i, j, k)] = open_area(region, static_cast<int>(d), a, b, {step_[d], step_[d]});
        });
    }

    template <class Visit>
    void each(Visit&& visit) const
    {
        for (int k = 0; k < n_[2]; ++k)
            for (int j = 0; j < n_[1]; ++j)
                for (int i = 0; i < n_[0]; ++i) visit(i, j, k);
    }
    Vec3 corner(int i, int j, int k) const { return low_ + Vec3{i * step_.x, j * step_.y, k * step_.z}; }
    std::size_t at(int i, int j, int k) const { return static_cast<std::size_t>((k * n_[1] + j) * n_[0] + i); }
    double area(std::size_t d, int i, int j, int k) const { return area_[d][at(i, j, k)]; }
    double volume() const
    {
        double sum = 0;
        for (double const one : volume_) sum += one;
        return sum;
    }

    //! Cells that can be reached from the one that holds x.
    std::vector<bool> reached(Vec3 const& x) const
    {
        std::vector<bool> out(volume_.size(), false);
        std::vector<std::array<int, 3>> waiting{{static_cast<int>((x.x - low_.x) / step_.x),
                                                 static_cast<int>((x.y - low_.y) / step_.y),
                                                 static_cast<int>((x.z - low_.z) / step_.z)}};
        out[at(waiting[0][0], waiting[0][1], waiting[0][2])] = true;
        while (!waiting.empty()) {
            auto const from = waiting.back();
            waiting.pop_back();
            for (std::size_t d = 0; d < 3; ++d)
                for (int const way : {-1, 1}) {
                    auto to = from;
                    to[d] += way;
                    if (to[d] < 0 || to[d] >= n_[d]) continue;
                    auto const& face = way < 0 ? from : to;
                    auto const cell = at(to[0], to[1], to[2]);
                    if (out[cell] || !(area(d, face[0], face[1], face[2]) > 0)) continue;
                    out[cell] = true;
                    waiting.push_back(to);
                }
        }
        return out;
    }
    bool reaches(Vec3 const& from, Vec3 const& to) const
    {
        return reached(
            from)[at(static_cast<int>((to.x - low_.x) / step_.x), static_cast<int>((to.y - low_.y) / step_.y),
                     static_cast<int>((to.z - low_.z) / step_.z))];
    }

  private:
    Vec3 low_, step_;
    std::array<int, 3> n_;
    std::array<std::vector<double>, 3> area_;
    std::vector<double> volume_;
};

Region const room("room", Box{{-1, -1, -1}, {1, 1, 1}});
}

TEST(ThinWall, a_shell_keeps_inside_and_outside_apart)
{
    // Cells are 0.2 and 0.154 wide.
    for (double const thickness : {0.1, 0.004, 1e-5})
        for (int const n : {10, 13})
            for (Vec3 const& centre : {Vec3{0.05, 0.03, -0.04}, Vec3{0.1, 0.1, 0.1}}) {
                Region const shell =
                    Region("outer", Ball{centre, 0.6}) - Region("inner", Ball{centre, 0.6 - thickness});
                Grid const grid(room - shell, {-1, -1, -1}, {1, 1, 1}, n);
                EXPECT_FALSE(grid.reaches(centre, {0.95, 0.95, 0.95}))
                    << "thickness " << thickness << ", " << n << " cells, about " << centre.x;
                EXPECT_TRUE(grid.reaches({-0.95, -0.95, -0.95}, {0.95, 0.95, 0.95}));
            }
}

TEST(ThinWall, a_shell_from_a_mesh_keeps_inside_and_outside_apart)
{
    Vec3 const centre{0.02, -0.03, 0.05};
    auto const mesh = closed(together(ball_surface(centre, 0.6, 24), turned_round(ball_surface(centre, 0.57, 24))));
    Grid const grid(room - Region("shell", mesh), {-1, -1, -1}, {1, 1, 1}, 8);
    EXPECT_FALSE(grid.reaches(centre, {0.95, 0.95, 0.95}));
}

TEST(ThinWall, plates_in_any_direction_keep_their_sides_apart)
{
    for (Vec3 const& raw :
         {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{1, 1, 1}, Vec3{1, 2, 3}, Vec3{1, 0, 0.05}, Vec3{0.3, 0.02, 1}})
        for (double const offset : {0.0, 0.1, 0.037, -0.101})
            for (double const thickness : {0.02, 0.0005}) {
                Vec3 const normal = raw / norm(raw);
                Region const plate = Region("front", HalfSpace{(offset + thickness / 2) * normal, normal}) &
                                     Region("back", HalfSpace{(offset - thickness / 2) * normal, -normal});
                Grid const grid(room - plate, {-1, -1, -1}, {1, 1, 1}, 10);
                Vec3 const a = -0.5 * normal, b = 0.5 * normal;
                EXPECT_FALSE(grid.reaches(a, b))
                    << raw.x << " " << raw.y << " " << raw.z << " at " << offset << ", " << thickness << " thick";
            }
}

TEST(ThinWall, shells_of_any_shape_and_thickness_in_stretched_cells_do_not_leak)
{
    for (unsigned seed = 1; seed <= 24; ++seed) {
        std::mt19937 random(seed);
        auto const draw = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
        };
        auto const cells = [&] { return static_cast<int>(draw(6, 13)); };
        std::array<int, 3> const n{cells(), cells(), cells()};
        double const thickness = 2.0 / std::max({n[0], n[1], n[2]}) * std::pow(10, draw(-4, 0.1));
        Vec3 const centre{draw(-0.1, 0.1), draw(-0.1, 0.1), draw(-0.1, 0.1)},
            raw{draw(-1, 1), draw(-1, 1), draw(-1, 1)};
        Vec3 const x = raw / norm(raw), aside = cross(x, Vec3{0.3, 0.5, 0.7}), y = aside / norm(aside), z = cross(x, y);
        auto const body = [&](double by) {
            if (seed % 3 == 0) return Region("ball", Ball{centre, 0.55 + by});
            if (seed % 3 == 1) return Region("cylinder", cylinder(centre - (0.5 + by) * x, x, 1 + 2 * by, 0.45 + by));
            Region cube("ball", Ball{centre, 2});
            for (auto const& side : {x, -x, y, -y, z, -z})
                cube = cube & Region("side", HalfSpace{centre + (0.4 + by) * side, side});
            return cube;
        };
        Grid const grid(room - (body(thickness) - body(0)), {-1, -1, -1}, {1, 1, 1}, n);
        EXPECT_FALSE(grid.reaches(centre, {-0.99, -0.99, -0.99})) << "seed " << seed;
    }
}

TEST(ThinWall, a_plate_that_nearly_fills_a_cell_keeps_its_sides_apart)
{
    // Cells from 0 to 0.2: the plate leaves slivers of them on both sides.
    for (auto const& [low, high] :
         {std::pair{0.002, 0.198}, {0.001, 0.195}, {0.03, 0.17}, {0.01, 0.2}, {-0.01, 0.19}}) {
        Grid const grid(room - Region("plate", Box{{-2, -2, low}, {2, 2, high}}), {-1, -1, -1}, {1, 1, 1}, 10);
        EXPECT_FALSE(grid.reaches({0, 0, -0.5}, {0, 0, 0.5})) << low << " to " << high;
    }
}

TEST(ThinWall, a_plate_close_to_a_thick_wall_keeps_the_slot_apart)
{
    // Between the block and the plate is a slot of a third of a cell. A cell belongs to the side of its open place.
    for (double const shift : {0.0, 0.03, 0.07, 0.11, 0.15}) {
        Region const region = room - Region("block", Box{{-2, -2, 0.3 + shift}, {2, 2, 2}}) -
                              Region("plate", Box{{-2, -2, 0.21 + shift}, {2, 2, 0.23 + shift}});
        int const n = 10;
        Vec3 const step{0.2, 0.2, 0.2};
        Grid const grid(region, {-1, -1, -1}, {1, 1, 1}, n);
        for (int k = 1; k < n; ++k) {
            if (!(grid.area(2, 5, 5, k) > 0)) continue;
            Vec3 const above = grid.corner(5, 5, k), below = grid.corner(5, 5, k - 1);
            auto const upper = open_place(region, above, above + step), lower = open_place(region, below, below + step);
            ASSERT_TRUE(upper && lower);
            EXPECT_EQ(upper->z > 0.22 + shift, lower->z > 0.22 + shift) << shift << ", " << k;
        }
    }
}

TEST(ThinWall, a_tube_is_open_at_its_ends_only)
{
    for (double const shift : {0.0, 0.03, 0.1}) {
        Region const region = room - Region("tube", tube({shift, 0.01, -0.5}, up, 1, 0.38, 0.4));
        Grid const grid(region, {-1, -1, -1}, {1, 1, 1}, 10);
        Vec3 const inside{shift, 0.01, 0.01}, outside{0.9, 0.9, 0.01};
        EXPECT_TRUE(grid.reaches(inside, outside)) << "around its ends";
        // With lids on it nothing gets out.
        Region const lids = region - Region("low", cylinder({shift, 0.01, -0.52}, up, 0.02, 0.4)) -
                            Region("high", cylinder({shift, 0.01, 0.5}, up, 0.02, 0.4));
        EXPECT_FALSE(Grid(lids, {-1, -1, -1}, {1, 1, 1}, 10).reaches(inside, outside)) << shift;
        // Its bore and the space around it stay open along the tube: what the wall's cells lose is their smaller part.
        double bore = 0;
        grid.each([&](int i, int j, int k) {
            if (k == 5) bore += grid.area(2, i, j, k);
        });
        EXPECT_LT(bore, 4 - pi * (0.16 - 0.1444) + 1e-3);
        EXPECT_GT(bore, 0.85 * 4);
        EXPECT_NEAR(grid.volume(), 8 - pi * (0.16 - 0.1444), 4e-3);
    }
}

TEST(ThinWall, thick_walls_lose_no_area)
{
    // Around the edges and corners of thick bodies not every place of a face is seen, but all are reached.
    Vec3 const axis = Vec3{1, 2, 2} / 3.0;
    auto const hemi = Region("ball", Ball{{0.1, 0, 0.1}, 0.5}) & Region("half", HalfSpace{{0.1, 0, 0.1}, axis});
    std::array const bodies{Region("block", Box{{-0.33, -0.41, -0.27}, {0.47, 0.33, 0.52}}),
                            Region("ball", Ball{{0.03, 0.02, 0.01}, 0.6}),
                            Region("cylinder", cylinder(-0.3 * axis, axis, 0.8, 0.37)), hemi};
    for (auto const& body : bodies) {
        double worst = 0, lost = 0, sum = 0;
        for (auto const& region : {room - body, body}) {
            int const n = 11;
            double const step = 2.0 / n;
            for (int k = 1; k < n; ++k)
                for (int j = 1; j < n; ++j)
                    for (int i = 1; i < n; ++i)
                        for (int d = 0; d < 3; ++d) {
                            Vec3 const a{-1 + i * step, -1 + j * step, -1 + k * step}, b = a + Vec3{step, step, step};
                            double const plain = open_area(region, d, a, b);
                            double const reached = open_area(region, d, a, b, {step, step});
                            worst = std::max(worst, std::abs(plain - reached) / (step * step));
                            lost += plain - reached, sum += plain;
                        }
        }
        EXPECT_LT(worst, 0.1) << body.name(0);
        EXPECT_LT(std::abs(lost) / sum, 5e-5) << body.name(0);
    }
}
