// Reads [[wall]]: bodies that granules touch besides the chamber, each with its shape, its material and its motion.
#include "granum/base/error.hpp"
#include "granum/geometry/stl.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/case_solid.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace granum::sim
{
using io::Dimension;

namespace
{
//! Reads the keys of one wall, all of which begin with `key`.
struct WallReader
{
    io::CaseFile& file;
    Case const& data;
    std::string key;  //!< "wall[2]."
    geometry::Body body{};

    Vec3 point(char const* name, char const* doc, std::optional<Vec3> fallback = std::nullopt)
    {
        return file.vector(key + name, Dimension::length, fallback, doc);
    }
    Vec3 direction(std::string const& name, std::optional<Vec3> fallback, char const* doc)
    {
        auto const given = file.vector(key + name, Dimension::one, fallback, doc);
        double const length = math::norm(given);
        if (length > 0) return (1 / length) * given;
        if (!file.wrong(key + name)) file.mistake(key + name, "has no direction", {"e.g. [0, 0, 1]"});
        return {0, 0, 1};
    }
    double length(char const* name, char const* doc, io::Range range = io::positive)
    {
        return file.quantity(key + name, Dimension::length, std::nullopt, doc, range);
    }

    geometry::Side side()
    {
        auto const name = file.name(key + "side", "both", "on which granules are; both: a thin wall",
                                    {"inside", "outside", "both"}, "a side");
        return name == "inside"    ? geometry::Side::inside
               : name == "outside" ? geometry::Side::outside
                                   : geometry::Side::both;
    }

    void frustum(bool cone)
    {
        geometry::Frustum wall;
        wall.base = point("base", "centre of the end where it begins");
        wall.axis = direction("axis", Vec3{0, 0, 1}, "from the base to the other end");
        wall.length = length("length", "along the axis");
        wall.base_radius = 0.5 * (cone ? length("base_diameter", "at the base", io::not_negative)
                                       : length("diameter", "of the cylinder"));
        wall.top_radius = cone ? 0.5 * length("top_diameter", "at the other end", io::not_negative) : wall.base_radius;
        wall.side = side();
        if (wall.base_radius == 0 && wall.top_radius == 0)
            file.mistake(key + "base_diameter", "and top_diameter are both 0");
        if (file.boolean(key + "closed", false, "its ends are closed by discs")) {
            Vec3 const top = wall.base + wall.length * wall.axis;
            if (wall.base_radius > 0) body.shapes.push_back(geometry::Disc{wall.base, wall.axis, wall.base_radius, 0});
            if (wall.top_radius > 0) body.shapes.push_back(geometry::Disc{top, wall.axis, wall.top_radius, 0});
        }
        body.shapes.push_back(wall);
    }

    void mesh()
    {
        auto const path = read_path(file, key + "file", "STL file beside the case or in a folder there");
        geometry::StlOptions options;
        options.scale = file.quantity(key + "unit", Dimension::length, 1e-3, "one unit of the file", io::positive);
        options.shift = point("shift", "added to every corner", Vec3{});
        if (!path || !std::isfinite(options.scale)) return;
        try {
            auto mesh = geometry::read_stl(*path, options);
            if (mesh.degenerate > 0)
                file.derived(key + "left_out", fmt::format("{}", mesh.degenerate), "triangles without area");
            file.note_contents(key + "file", *path);
            body.shapes.push_back(std::move(mesh.mesh));
        } catch (base::Error const& error) {
            file.mistake(key + "file", error.what(), {"the path is relative to the case"});
        }
    }

    void shape()
    {
        auto const kind = file.name(key + "shape", std::nullopt, "of the wall",
                                    {"plane", "cylinder", "cone", "box", "disc", "sphere", "stl"}, "a shape of a wall");
        if (kind == "plane") {
            auto const at = point("point", "of the plane");
            body.shapes.push_back(
                geometry::Plane{at, direction("normal", std::nullopt, "to the side on which granules are")});
        } else if (kind == "cylinder" || kind == "cone") {
            frustum(kind == "cone");
        } else if (kind == "box") {
            auto const lower = point("lower", "corner"), upper = point("upper", "corner");
            bool const good = lower.x < upper.x && lower.y < upper.y && lower.z < upper.z;
            if (!good && !file.wrong(key + "lower") && !file.wrong(key + "upper"))
                file.mistake(key + "upper", "is not above the lower corner");
            body.shapes = geometry::box_inside(lower, upper);
        } else if (kind == "disc") {
            geometry::Disc disc;
            disc.centre = point("centre", "of the disc");
            disc.normal = direction("normal", Vec3{0, 0, 1}, "of the disc");
            disc.radius = 0.5 * length("diameter", "of the disc");
            disc.hole =
                0.5 * file.quantity(key + "hole", Dimension::length, 0, "diameter of the hole", io::not_negative);
            if (disc.hole >= disc.radius) file.mistake(key + "hole", "is not smaller than the disc");
            body.shapes.push_back(disc);
        } else if (kind == "sphere") {
            geometry::Sphere sphere;
            sphere.centre = point("centre", "of the sphere");
            sphere.radius = 0.5 * length("diameter", "of the sphere");
            sphere.side = side();
            body.shapes.push_back(sphere);
        } else if (kind == "stl") {
            mesh();
        }
        for (auto const* name :
             {"base", "axis", "length", "diameter", "base_diameter", "top_diameter", "side", "closed", "file", "unit",
              "shift", "point", "normal", "lower", "upper", "centre", "hole"}) {
            bool const asked = asks(kind, name);
            file.know(key + name);
            if (file.has(key + name) && !asked && !file.wrong(key + "shape"))
                file.mistake(key + name, fmt::format("does not belong to shape = \"{}\"", kind));
        }
    }

    static bool asks(std::string const& kind, std::string const& name)
    {
        auto const one_of = [&](std::initializer_list<char const*> names) {
            return std::any_of(names.begin(), names.end(), [&](char const* other) { return name == other; });
        };
        if (kind == "plane") return one_of({"point", "normal"});
        if (kind == "cylinder") return one_of({"base", "axis", "length", "diameter", "side", "closed"});
        if (kind == "cone")
            return one_of({"base", "axis", "length", "base_diameter", "top_diameter", "side", "closed"});
        if (kind == "box") return one_of({"lower", "upper"});
        if (kind == "disc") return one_of({"centre", "normal", "diameter", "hole"});
        if (kind == "sphere") return one_of({"centre", "diameter", "side"});
        return one_of({"file", "unit", "shift"});
    }

    bool moves(std::string const& name)
    {
        file.section(key + name);
        return file.has(key + name) && !file.wrong(key + name);
    }
    geometry::Period period(std::string const& of)
    {
        geometry::Period when;
        when.start = file.quantity(key + of + ".start", Dimension::time, 0, "when it begins", io::not_negative);
        when.stop = file.optional_quantity(key + of + ".stop", Dimension::time, "when it ends", io::not_negative)
                        .value_or(when.stop);
        if (when.stop <= when.start) file.mistake(key + of + ".stop", "is not after the start");
        return when;
    }

    //! In this order they act: turned about an axis that stands still, shaken, moved along, pressed on.
    void motion()
    {
        if (moves("rotate")) {
            geometry::Rotation motion;
            motion.point = point("rotate.point", "of the axis", Vec3{});
            motion.axis = direction("rotate.axis", std::nullopt, "positive rates turn by the right-hand rule");
            motion.rate = file.quantity(key + "rotate.rate", Dimension::angular_speed, std::nullopt, "of the rotation");
            motion.when = period("rotate");
            body.motions.push_back(motion);
        }
        if (moves("vibrate")) {
            geometry::Vibration motion;
            motion.direction = direction("vibrate.direction", std::nullopt, "of the vibration");
            motion.amplitude = length("vibrate.amplitude", "half of the way");
            motion.frequency =
                file.quantity(key + "vibrate.frequency", Dimension::count_rate, std::nullopt, "in 1/s", io::positive);
            motion.phase = file.quantity(key + "vibrate.phase", Dimension::angle, 0, "at its start");
            motion.when = period("vibrate");
            body.motions.push_back(motion);
        }
        if (moves("move")) {
            geometry::Translation motion;
            motion.velocity = file.vector(key + "move.velocity", Dimension::velocity, std::nullopt, "of the wall");
            motion.when = period("move");
            body.motions.push_back(motion);
        }
        if (moves("servo")) servo();
    }

    void servo()
    {
        geometry::Servo motion;
        motion.direction = direction("servo.direction", std::nullopt, "towards the granules");
        motion.pressure =
            file.quantity(key + "servo.pressure", Dimension::pressure, std::nullopt, "to press with", io::positive);
        motion.fastest =
            file.quantity(key + "servo.fastest", Dimension::velocity, std::nullopt, "speed limit", io::positive);
        auto const area = file.optional_quantity(key + "servo.area", Dimension::area, "of the wall", io::positive);
        auto const own = body.shapes.empty() ? std::nullopt : geometry::facing_area(body, motion.direction);
        if (!area && (!own || !(*own > 0)) && !body.shapes.empty())
            file.mistake(key + "servo.area", "is missing", {"the area that the pressure acts on, e.g. \"0.01 m2\""});
        motion.area = area.value_or(own.value_or(1));
        motion.when = period("servo");
        body.motions.push_back(motion);
    }

    void read()
    {
        body.name = file.words(key + "name", "wall-" + key.substr(5, key.size() - 7), "in walls.csv and ParaView");
        check_column_name(file, key + "name", body.name);
        body.material = read_material(file, data.contact, key + "material", 1, "it is made of");
        shape();
        motion();
    }
};
}

void read_walls(io::CaseFile& file, Case& data)
{
    std::set<std::string> const taken{"chamber", "left", "right", "front", "back", "bottom", "top"};
    auto names = taken;
    for (auto const& body : data.bodies) names.insert(body.name);
    int const count = file.count("wall");
    if (count > 0 && file.has("gas"))
        file.mistake("wall", "goes with granules alone: gas knows the chamber and its bodies only",
                     {"make it a body, [[internal]], or leave out [gas] or [[wall]]"});
    for (int i = 0; i < count; ++i) {
        WallReader reader{file, data, fmt::format("wall[{}].", i)};
        reader.read();
        auto const& name = reader.body.name;
        if (!names.insert(name).second)
            file.mistake(
                reader.key + "name",
                fmt::format("is that of {} too", taken.contains(name) ? "the chamber" : "another wall or body"));
        data.walls.push_back(std::move(reader.body));
    }
}
}
