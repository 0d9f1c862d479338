// Cut cells: open volumes and areas against closed forms, cell by cell and in sum.
#include "granum/geometry/open_part.hpp"

#include "granum/geometry/ball_in_box.hpp"
#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace granum::geometry;
using namespace granum::scene;
using granum::math::pi;

namespace
{
struct Cells
{
    Vec3 low, high;
    int n;

    Vec3 size() const { return (1.0 / n) * (high - low); }
    double largest() const { return std::max({size().x, size().y, size().z}); }
    template <class Visit>
    void each(Visit&& visit) const
    {
        Vec3 const s = size();
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    Vec3 const a = low + Vec3{i * s.x, j * s.y, k * s.z};
                    visit(a, a + s);
                }
    }
};

struct Errors
{
    double worst = 0, sum = 0, exact = 0;
    int cut = 0;
};

//! Differences of the open share of cells from the exact one.
Errors volume_errors(Region const& region, Cells const& cells,
                     std::function<double(Vec3 const&, Vec3 const&)> const& exact)
{
    Errors out;
    double const whole = cells.size().x * cells.size().y * cells.size().z;
    cells.each([&](Vec3 const& a, Vec3 const& b) {
        double const is = open_volume(region, a, b), should = exact(a, b);
        out.worst = std::max(out.worst, std::abs(is - should) / whole);
        out.sum += is - should;
        out.exact += should;
        out.cut += should > 1e-9 * whole && should < (1 - 1e-9) * whole;
    });
    return out;
}

Errors area_errors(Region const& region, Cells const& cells,
                   std::function<double(int, Vec3 const&, Vec3 const&)> const& exact)
{
    Errors out;
    Vec3 const s = cells.size();
    cells.each([&](Vec3 const& a, Vec3 const& b) {
        for (int d = 0; d < 3; ++d) {
            double const whole = s.x * s.y * s.z / s[static_cast<std::size_t>(d)];
            double const is = open_area(region, d, a, b), should = exact(d, a, b);
            out.worst = std::max(out.worst, std::abs(is - should) / whole);
            out.sum += is - should;
            out.exact += should;
            out.cut += should > 1e-9 * whole && should < (1 - 1e-9) * whole;
        }
    });
    return out;
}

//! Part of the box [a, b] where normal . x < offset, all components of the normal above 0: inclusion and exclusion of
//! the corners' simplices.
double behind_plane(Vec3 const& normal, double offset, Vec3 const& a, Vec3 const& b)
{
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double depth = offset, sign = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            bool const far = (corner >> d & 1) != 0;
            depth -= normal[d] * (far ? b[d] : a[d]);
            if (far) sign = -sign;
        }
        if (depth > 0) sum += sign * depth * depth * depth / (6 * normal.x * normal.y * normal.z);
    }
    return sum;
}

//! The same of the rectangle at a[d].
double behind_line(Vec3 const& normal, double offset, std::size_t d, Vec3 const& a, Vec3 const& b)
{
    std::size_t const u = (d + 1) % 3, v = (d + 2) % 3;
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
        bool const far_u = (corner & 1) != 0, far_v = (corner & 2) != 0;
        double const depth =
            offset - normal[d] * a[d] - normal[u] * (far_u ? b[u] : a[u]) - normal[v] * (far_v ? b[v] : a[v]);
        if (depth > 0) sum += (far_u == far_v ? 1 : -1) * depth * depth / (2 * normal[u] * normal[v]);
    }
    return sum;
}

//! The circle of a ball about the middle of space in the plane of a face.
double ball_on_face(double radius, int direction, Vec3 const& a, Vec3 const& b)
{
    auto const d = static_cast<std::size_t>(direction), u = (d + 1) % 3, v = (d + 2) % 3;
    double const left = radius * radius - a[d] * a[d];
    return left > 0 ? circle_rectangle_area(std::sqrt(left), a[u], b[u], a[v], b[v]) : 0;
}

Cells const around_ball{{-1.1, -1.13, -1.07}, {1.12, 1.05, 1.09}, 16};
Vec3 const up{0, 0, 1};
}

TEST(OpenVolume, of_tilted_planes_is_exact)
{
    std::mt19937 random(8);
    auto const draw = [&] { return 0.02 + static_cast<double>(random()) / 4294967296.0; };
    for (int k = 0; k < 20; ++k) {
        Vec3 const raw{draw(), draw(), k < 10 ? draw() : 1e-3}, normal = raw / norm(raw);
        double const offset = 0.3 + 0.5 * draw();
        Region const region("below", HalfSpace{offset * normal, normal});
        Cells const cells{{0, 0, 0}, {1, 1.5, 0.7}, 5};
        auto const volume = volume_errors(
            region, cells, [&](Vec3 const& a, Vec3 const& b) { return behind_plane(normal, offset, a, b); });
        EXPECT_LT(volume.worst, 1e-9);
        EXPECT_GT(volume.cut, 10);
        auto const area = area_errors(region, cells, [&](int d, Vec3 const& a, Vec3 const& b) {
            return behind_line(normal, offset, static_cast<std::size_t>(d), a, b);
        });
        EXPECT_LT(area.worst, 1e-8);
    }
}

TEST(OpenPart, of_a_plane_has_the_centroid_and_the_wall_of_the_plane)
{
    // What the wall adds to the faces closes the cell: the sum of areas times normals is along the wall's normal.
    Vec3 const normal = Vec3{1, 2, 2} / 3.0;
    Region const region("below", HalfSpace{0.4 * normal, normal});
    Vec3 const low{0, 0, 0}, high{0.6, 0.4, 0.5};
    Vec3 wall;
    for (std::size_t d = 0; d < 3; ++d) {
        Vec3 far = low;
        far[d] = high[d];
        Vec3 top = high;
        top[d] += 1;
        wall[d] = open_area(region, static_cast<int>(d), low, high) - open_area(region, static_cast<int>(d), far, top);
    }
    EXPECT_NEAR(norm(wall - dot(wall, normal) * normal), 0, 1e-12);
    EXPECT_GT(dot(wall, normal), 0.1);
    // Centroid against the mean over many places.
    auto const part = open_part(region, low, high);
    EXPECT_NEAR(part.volume, behind_plane(normal, 0.4, low, high), 1e-14);
    Vec3 sum;
    int const n = 120;
    int count = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                Vec3 const x{0.6 * (i + 0.5) / n, 0.4 * (j + 0.5) / n, 0.5 * (k + 0.5) / n};
                if (dot(x, normal) < 0.4) sum += x, ++count;
            }
    EXPECT_LT(norm(part.centroid - sum / static_cast<double>(count)), 2e-4);
    EXPECT_EQ(open_part(region, {2, 2, 2}, {3, 3, 3}).volume, 0);
    EXPECT_EQ(open_part(region, {2, 2, 2}, {3, 3, 4}).centroid, (Vec3{2.5, 2.5, 3}));
}

TEST(OpenVolume, of_a_ball_agrees_with_the_ball_in_every_cell)
{
    // ball_in_box is exact to 5e-5 of the ball, which is 8e-2 of a cell here: only where one face cuts it is exact.
    Region const region("ball", Ball{{}, 1});
    auto const errors =
        volume_errors(region, around_ball, [](Vec3 const& a, Vec3 const& b) { return ball_in_box({}, 1, a, b); });
    EXPECT_LT(std::abs(errors.sum) / errors.exact, 3e-5);
    EXPECT_GT(errors.cut, 300);
}

TEST(OpenArea, of_a_ball_is_that_of_its_circles_on_every_face)
{
    Region const region("ball", Ball{{}, 1});
    auto const errors =
        area_errors(region, around_ball, [](int d, Vec3 const& a, Vec3 const& b) { return ball_on_face(1, d, a, b); });
    EXPECT_LT(errors.worst, 3e-3);
    EXPECT_LT(std::abs(errors.sum) / errors.exact, 3e-5);
    EXPECT_GT(errors.cut, 500);
}

TEST(OpenPart, around_a_ball_is_what_the_ball_leaves)
{
    Region const inside("ball", Ball{{}, 1}), around = Region("all", Box{{-3, -3, -3}, {3, 3, 3}}) - inside;
    around_ball.each([&](Vec3 const& a, Vec3 const& b) {
        Vec3 const s = b - a;
        EXPECT_NEAR(open_volume(inside, a, b) + open_volume(around, a, b), s.x * s.y * s.z, 1e-3 * s.x * s.y * s.z);
        EXPECT_NEAR(open_area(inside, 1, a, b) + open_area(around, 1, a, b), s.x * s.z, 2e-3 * s.x * s.z);
    });
}

TEST(OpenVolume, of_cylinders_along_each_axis_is_circle_times_length_in_every_cell)
{
    for (std::size_t d = 0; d < 3; ++d) {
        Vec3 axis, base;
        axis[d] = 1, base[d] = -0.7;
        std::size_t const u = (d + 1) % 3, v = (d + 2) % 3;
        Region const region("cylinder", cylinder(base, axis, 1.5, 0.8));
        Cells const cells{{-0.97, -1.03, -0.99}, {1.01, 0.96, 0.95}, 12};
        auto const errors = volume_errors(region, cells, [&](Vec3 const& a, Vec3 const& b) {
            double const length = std::max(0.0, std::min(b[d], 0.8) - std::max(a[d], -0.7));
            return length * circle_rectangle_area(0.8, a[u], b[u], a[v], b[v]);
        });
        EXPECT_LT(errors.worst, 2e-3) << "axis " << d;
        EXPECT_LT(std::abs(errors.sum) / errors.exact, 1e-4) << "axis " << d;
    }
}

TEST(OpenVolume, of_slanted_cylinders_cones_and_tubes_adds_up)
{
    Vec3 const axis = Vec3{1, 2, 2} / 3.0, base{-0.3, -0.6, -0.6};
    Cells const cells{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}, 24};
    auto const sum = [&](Solid const& solid) {
        double out = 0;
        Region const region("solid", solid);
        cells.each([&](Vec3 const& a, Vec3 const& b) { out += open_volume(region, a, b); });
        return out;
    };
    EXPECT_NEAR(sum(cylinder(base, axis, 1.2, 0.5)) / (pi * 0.25 * 1.2), 1, 2e-4);
    EXPECT_NEAR(sum(cone_frustum(base, axis, 1.2, 0.3, 0.6)) / (pi / 3 * 1.2 * (0.09 + 0.18 + 0.36)), 1, 3e-4);
    EXPECT_NEAR(sum(cone_frustum(base, axis, 1.2, 0.6, 0)) / (pi / 3 * 1.2 * 0.36), 1, 3e-4);
    EXPECT_NEAR(sum(tube(base, axis, 1.2, 0.4, 0.5)) / (pi * 0.09 * 1.2), 1, 5e-4);
    // A wall of a sixth of a cell.
    EXPECT_NEAR(sum(tube(base, axis, 1.2, 0.48, 0.5)) / (pi * (0.25 - 0.2304) * 1.2), 1, 2e-2);
}

TEST(OpenPart, of_a_cone_is_the_sum_of_its_circles_and_chords)
{
    std::vector<ProfilePoint> const profile{{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}};
    Region const region("chamber", turned(profile));
    Cells const cells{{-0.125, -0.125, 0}, {0.125, 0.125, 1}, 15};
    auto const radius = [](double z) { return std::min(0.125, 0.09 + 0.035 * z / 0.45); };
    auto const over_height = [](Vec3 const& a, Vec3 const& b, auto&& part) {
        int const layers = 2000;
        double const rise = (b.z - a.z) / layers;
        double sum = 0;
        for (int k = 0; k < layers; ++k) sum += rise * part(a.z + (k + 0.5) * rise);
        return sum;
    };
    auto const volume = volume_errors(region, cells, [&](Vec3 const& a, Vec3 const& b) {
        return over_height(a, b, [&](double z) { return circle_rectangle_area(radius(z), a.x, b.x, a.y, b.y); });
    });
    EXPECT_LT(volume.worst, 2e-3);
    EXPECT_LT(std::abs(volume.sum) / volume.exact, 5e-5);
    EXPECT_GT(volume.cut, 500);
    auto const area = area_errors(region, cells, [&](int d, Vec3 const& a, Vec3 const& b) {
        // The plate closes the face that it lies on.
        if (d == 2) return a.z == 0 ? 0 : circle_rectangle_area(radius(a.z), a.x, b.x, a.y, b.y);
        double const plane = d == 0 ? a.x : a.y, from = d == 0 ? a.y : a.x, to = d == 0 ? b.y : b.x;
        return over_height(a, b, [&](double z) {
            double const half = std::sqrt(std::max(0.0, radius(z) * radius(z) - plane * plane));
            return std::max(0.0, std::min(to, half) - std::max(from, -half));
        });
    });
    EXPECT_LT(area.worst, 3e-3);
    EXPECT_LT(std::abs(area.sum) / area.exact, 5e-5);
    EXPECT_GT(area.cut, 500);
}

TEST(OpenPart, of_a_chamber_alone_has_the_bits_of_the_exact_formulas)
{
    Chamber const chamber{.shape = Chamber::Shape::revolution, .profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}}};
    // The nozzle is far from most cells.
    Region const region = Region("chamber", chamber) - Region("nozzle", cylinder({0, 0, -0.1}, up, 0.15, 0.01));
    int exact = 0;
    Cells const cells{{-0.125, -0.125, 0}, {0.125, 0.125, 1}, 15};
    cells.each([&](Vec3 const& a, Vec3 const& b) {
        double const away = std::max({-b.x, a.x, -b.y, a.y, a.z - 0.05});  // of the cell from the middle of the nozzle
        if (away < 0.05) return;
        double const whole = (b.x - a.x) * (b.y - a.y) * (b.z - a.z);
        double const volume = open_volume(region, a, b);
        if (volume == whole || volume == 0) return;
        EXPECT_EQ(volume, chamber.open_volume(a, b));
        EXPECT_EQ(open_part(region, a, b).volume, volume);
        double const area = open_area(region, 0, a, b, {0.02, 0.02}), face = (b.y - a.y) * (b.z - a.z);
        if (std::abs(area - face) > 1e-12) {
            EXPECT_EQ(area, chamber.open_area(0, a, b));
        }
        ++exact;
    });
    EXPECT_GT(exact, 500);
    // The nozzle takes its share.
    double sum = 0;
    cells.each([&](Vec3 const& a, Vec3 const& b) { sum += open_volume(region, a, b); });
    EXPECT_NEAR((chamber.volume() - sum) / (pi * 1e-4 * 0.05), 1, 1e-2);
}

TEST(OpenPart, converges_at_second_order_for_curved_walls)
{
    // Tangent planes in half cells would leave h^2 / (16 R^2) of a ball; with the bend of the wall much less is left.
    Region const region("ball", Ball{{0.013, -0.021, 0.008}, 1});
    for (int const n : {6, 12, 24, 48}) {
        double volume = 0, area = 0;
        Cells const cells{{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}, n};
        cells.each([&](Vec3 const& a, Vec3 const& b) {
            volume += open_volume(region, a, b);
            if (std::abs(a.z) < 1e-12) area += open_area(region, 2, a, b);
        });
        double const share = cells.largest() * cells.largest();
        EXPECT_LT(std::abs(volume / (4.0 / 3 * pi) - 1), 1e-3 * share) << n;
        EXPECT_LT(std::abs(area / (pi * (1 - 0.008 * 0.008)) - 1), 1e-3 * share) << n;
    }
}

TEST(OpenVolume, of_joined_solids_has_no_wall_in_the_seam)
{
    Region const region = Region("low", cylinder({}, up, 0.5, 0.4)) |
                          Region("high", cone_frustum({0, 0, 0.5}, up, 0.5, 0.4, 0.2)) |
                          Region("aside", Box{{0, -0.2, 0.1}, {0.7, 0.2, 0.4}});
    // The seam lies on faces for the first, within cells for the second.
    for (int const n : {10, 11}) {
        Cells const cells{{-0.8, -0.8, 0}, {0.8, 0.8, 1}, n};
        cells.each([&](Vec3 const& a, Vec3 const& b) {
            double const r = std::hypot(std::max(std::abs(a.x), std::abs(b.x)), std::max(std::abs(a.y), std::abs(b.y)));
            Vec3 const s = b - a;
            if (r < 0.3 && a.z >= 0 && b.z < 0.8) {
                EXPECT_NEAR(open_volume(region, a, b), s.x * s.y * s.z, 1e-12 * s.x * s.y * s.z);
                for (std::size_t d = a.z > 0 ? 0 : 1; d < 3; ++d) {
                    std::size_t const e = (d + 2) % 3;  // z last, and not on the plate
                    EXPECT_NEAR(open_area(region, static_cast<int>(e), a, b, {s[e], s[e]}) * s[e], s.x * s.y * s.z,
                                1e-12 * s.x * s.y * s.z);
                }
            }
        });
        double sum = 0, seam = 0;
        cells.each([&](Vec3 const& a, Vec3 const& b) {
            sum += open_volume(region, a, b);
            if (std::abs(a.z - 0.5) < 1e-12) seam += open_area(region, 2, a, b, {0.1, 0.1});
        });
        // The box beyond the cylinder: 0.3 x 0.4 x (0.7 - ...) = box less what the circle takes of it.
        double const box = 0.3 * (0.7 * 0.4 - circle_rectangle_area(0.4, 0, 0.7, -0.2, 0.2));
        EXPECT_NEAR(sum / (pi * 0.16 * 0.5 + pi / 3 * 0.5 * (0.16 + 0.08 + 0.04) + box), 1, 5e-4);
        if (n == 10) {
            EXPECT_NEAR(seam / (pi * 0.16), 1, 1e-3);
        }
    }
}

TEST(OpenArea, of_a_face_on_a_wall_is_closed_and_of_an_end_is_what_its_cell_sees)
{
    Region const region =
        Region("box", Box{{0, 0, 0}, {1, 1, 1}}) - Region("block", Box{{0.3, 0, 0}, {0.6, 0.45, 0.5}});
    Vec3 const low{0.25, 0.25, 0.5}, high{0.5, 0.5, 0.75};
    // A fifth of the face is free of the block in x, and a fifth of the rest in y.
    double const free = 0.05 * 0.25 + 0.2 * 0.05;
    EXPECT_NEAR(open_area(region, 2, low, high), free, 2e-4 * 0.0625);
    EXPECT_NEAR(open_area(region, 2, low, high, {0.25, 0.25}), free, 2e-4 * 0.0625);
    EXPECT_NEAR(open_area(region, 2, low, high, {0, 0.25}), 0.0625, 1e-15) << "seen from above";
    EXPECT_NEAR(open_area(region, 2, low, high, {0.25, 0}), free, 2e-4 * 0.0625) << "seen from below";
    // Ends of the box.
    EXPECT_EQ(open_area(region, 0, {0, 0.5, 0.5}, {0.25, 0.75, 0.75}), 0);
    EXPECT_NEAR(open_area(region, 0, {0, 0.5, 0.5}, {0.25, 0.75, 0.75}, {0, 0.25}), 0.0625, 1e-15);
    EXPECT_EQ(open_area(region, 0, {0, 0.5, 0.5}, {0.25, 0.75, 0.75}, {0.25, 0}), 0);
    EXPECT_NEAR(open_area(region, 0, {1, 0.5, 0.5}, {1.25, 0.75, 0.75}, {0.25, 0}), 0.0625, 1e-15);
}

TEST(OpenArea, of_plate_and_outlet_is_their_disc_whatever_the_chamber_is_made_of)
{
    std::vector<ProfilePoint> const profile{{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}};
    Chamber const chamber{.shape = Chamber::Shape::revolution, .profile = profile};
    auto outline = profile;
    outline.insert(outline.begin(), {0, 0});
    outline.push_back({1, 0});
    auto const surface = turned_surface(outline, 180);
    Region const exact("chamber", chamber), round("round", turned(profile)), mesh("mesh", closed(surface));
    int const n = 14;
    double const step = 0.25 / n;
    for (Region const* region : {&exact, &round, &mesh}) {
        for (double const z : {0.0, 1.0}) {
            double sum = 0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    sum += open_area(*region, 2, {-0.125 + i * step, -0.125 + j * step, z},
                                     {-0.125 + (i + 1) * step, -0.125 + (j + 1) * step, z + 0.02},
                                     {z > 0 ? 0.02 : 0, z > 0 ? 0 : 0.02});
            double const r = z > 0 ? 0.125 : 0.09;
            double const disc = region == &mesh ? 180.0 / 2 * std::sin(2 * pi / 180) * r * r : pi * r * r;
            EXPECT_NEAR(sum / disc, 1, 1e-3) << region->name(0) << " at " << z;
        }
    }
}

TEST(OpenPart, of_a_mesh_is_that_of_the_solid_it_draws)
{
    Vec3 const low{-0.31, -0.22, 0.07}, high{0.43, 0.37, 0.81};
    Region const box("box", Box{low, high}), mesh("mesh", closed(box_surface(low, high, 5)));
    Cells const cells{{-0.5, -0.5, 0}, {0.5, 0.5, 1}, 9};
    double const face = cells.size().x * cells.size().y, whole = face * cells.size().z;
    cells.each([&](Vec3 const& a, Vec3 const& b) {
        EXPECT_NEAR(open_volume(mesh, a, b), open_volume(box, a, b), 1e-12 * whole);
        for (int d = 0; d < 3; ++d) EXPECT_NEAR(open_area(mesh, d, a, b), open_area(box, d, a, b), 1e-10 * face);
    });
    // A polyhedron has the volume of its pyramids; its cells must add up to it.
    auto const ball = closed(ball_surface({0.01, 0.02, 0.5}, 0.45, 40));
    double sum = 0;
    cells.each([&](Vec3 const& a, Vec3 const& b) { sum += open_volume(Region("ball", ball), a, b); });
    EXPECT_NEAR(sum / ball->volume(), 1, 1e-4);
}

TEST(OpenArea, of_a_shared_face_is_the_same_from_both_cells)
{
    Region const region = (Region("low", cylinder({}, up, 0.5, 0.4)) | Region("high", Ball{{0, 0, 0.5}, 0.4})) -
                          Region("tube", tube({0, 0.05, 0.1}, Vec3{0.6, 0, 0.8}, 0.4, 0.1, 0.104));
    Cells const cells{{-0.4, -0.4, 0}, {0.4, 0.4, 0.9}, 9};
    cells.each([&](Vec3 const& a, Vec3 const& b) {
        for (std::size_t d = 0; d < 3; ++d) {
            Vec3 below = a, above_low = a, above_high = b;
            below[d] -= (b - a)[d];
            Vec3 const of_below_high = [&] {
                Vec3 x = b;
                x[d] = a[d];
                return x;
            }();
            // The cell above calls it its lower face, the cell below its upper face.
            double const from_above =
                open_area(region, static_cast<int>(d), above_low, above_high, {(b - a)[d], (b - a)[d]});
            Vec3 face_low = below;
            face_low[d] = of_below_high[d];
            double const from_below =
                open_area(region, static_cast<int>(d), face_low, of_below_high, {(b - a)[d], (b - a)[d]});
            EXPECT_EQ(from_above, from_below);
        }
    });
}
