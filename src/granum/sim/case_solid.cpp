#include "granum/sim/case_solid.hpp"

#include "granum/geometry/closed_mesh.hpp"
#include "granum/geometry/stl_solid.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace granum::sim
{
using geometry::Vec3;
using io::Dimension;

std::optional<std::string> read_path(io::CaseFile& file, std::string const& key, std::string const& doc)
{
    auto const name = file.words(key, std::nullopt, doc);
    if (file.wrong(key)) return std::nullopt;
    auto const path = std::filesystem::path(name).lexically_normal();
    if (path.is_absolute() || path.empty() || *path.begin() == "..") {
        file.mistake(key, "leads out of the folder of the case", {"put the file beside the case"});
        return std::nullopt;
    }
    return file.beside(path.string());
}

namespace
{
constexpr double too_large = 3, too_small = 1.0 / 2000;  // over the apparatus: a body in another unit
constexpr double largest_apparatus = 100;                // m: one of a thousand times a metre

std::map<std::string, std::vector<std::string>> const keys_of_shape{
    {"box", {"lower", "upper"}},
    {"cylinder", {"base", "axis", "length", "diameter"}},
    {"cone", {"base", "axis", "length", "base_diameter", "top_diameter"}},
    {"sphere", {"centre", "diameter"}},
    {"tube", {"base", "axis", "length", "inner_diameter", "outer_diameter"}},
    {"profile", {"base", "axis", "profile"}},
    {"stl", {"file", "unit", "shift", "expected_size"}}};

struct Reader
{
    io::CaseFile& file;
    std::string key;
    double apparatus;

    Vec3 point(char const* name, char const* doc, std::optional<Vec3> fallback = std::nullopt)
    {
        return file.vector(key + name, Dimension::length, fallback, doc);
    }
    double length(char const* name, char const* doc, io::Range range = io::positive)
    {
        return file.quantity(key + name, Dimension::length, std::nullopt, doc, range);
    }
    Vec3 axis()
    {
        auto const given = file.vector(key + "axis", Dimension::one, Vec3{0, 0, 1}, "from the base to the other end");
        double const size = math::norm(given);
        if (size > 0) return (1 / size) * given;
        if (!file.wrong(key + "axis")) file.mistake(key + "axis", "has no direction", {"e.g. [0, 0, 1]"});
        return {0, 0, 1};
    }
    bool wrong(std::initializer_list<char const*> names) const
    {
        return std::any_of(names.begin(), names.end(), [&](char const* name) { return file.wrong(key + name); });
    }

    geometry::Solid box()
    {
        auto const lower = point("lower", "corner"), upper = point("upper", "opposite corner");
        for (std::size_t d = 0; d < 3 && !wrong({"lower", "upper"}); ++d)
            if (!(lower[d] < upper[d]))
                file.mistake(
                    key + "upper", fmt::format("leaves the box no thickness along {}", "xyz"[d]),
                    {fmt::format("it must be above lower, {:.4g} mm; a wall needs a thickness, of a millimetre "
                                 "or so",
                                 1e3 * lower[d])});
        return geometry::Box{lower, upper};
    }

    geometry::Solid cone()
    {
        auto const base = point("base", "centre of the end where it begins"), along = axis();
        double const high = length("length", "along the axis");
        double const low = 0.5 * length("base_diameter", "at the base", io::not_negative);
        double const top = 0.5 * length("top_diameter", "at the other end", io::not_negative);
        if (low == 0 && top == 0) file.mistake(key + "base_diameter", "and top_diameter are both 0");
        if (low > 0 && top > 0) return geometry::cone_frustum(base, along, high, low, top);
        std::vector<geometry::ProfilePoint> outline{{0, 0}};
        if (low > 0) outline.push_back({0, low});
        if (top > 0) outline.push_back({high, top});
        outline.push_back({high, 0});
        return geometry::Revolution(base, along, outline);
    }

    geometry::Solid tube()
    {
        auto const base = point("base", "centre of the end where it begins"), along = axis();
        double const high = length("length", "along the axis");
        double const inner = 0.5 * length("inner_diameter", "of the bore");
        double const outer = 0.5 * length("outer_diameter", "of the tube");
        if (!wrong({"inner_diameter", "outer_diameter"}) && !(inner < outer))
            file.mistake(key + "outer_diameter", "leaves the tube no wall: it is not above inner_diameter",
                         {"a wall needs a thickness, of a millimetre or so"});
        return geometry::tube(base, along, high, inner, outer);
    }

    geometry::Solid profile()
    {
        auto const base = point("base", "from where heights count", Vec3{}), along = axis();
        auto const rows = file.table(key + "profile", 2, Dimension::length, "rows of height and diameter, rising");
        std::vector<geometry::ProfilePoint> outline;
        if (rows.size() < 2 && !file.wrong(key + "profile"))
            file.mistake(key + "profile", rows.empty() ? "is missing" : "needs at least two rows",
                         {"rows of height and diameter, e.g. [[\"0 mm\", \"180 mm\"], [\"1 m\", \"180 mm\"]]"});
        for (std::size_t k = 0; k < rows.size(); ++k) {
            double const radius = 0.5 * rows[k][1];
            if (k > 0 && !(rows[k][0] >= rows[k - 1][0])) {
                file.mistake(key + "profile", "must rise from row to row");
                break;
            }
            if (k == 0 && radius > 0) outline.push_back({rows[k][0], 0});
            outline.push_back({rows[k][0], radius});
            if (k + 1 == rows.size() && radius > 0) outline.push_back({rows[k][0], 0});
        }
        return geometry::Revolution(base, along, outline);
    }

    double unit()
    {
        constexpr auto doc = "one unit of the file";
        static std::map<std::string, double> const names{{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}};
        for (auto const& [name, size] : names)
            if (file.says(key + "unit", name)) {
                file.words(key + "unit", name, doc);
                return size;
            }
        return file.quantity(key + "unit", Dimension::length, 1e-3, doc, io::positive);
    }

    std::optional<geometry::Solid> mesh()
    {
        geometry::StlSolidOptions options;
        options.stl.scale = unit();
        options.stl.shift = point("shift", "added to every corner", Vec3{});
        auto const expected = file.optional_quantity(key + "expected_size", Dimension::length,
                                                     "of the body, about: catches a wrong unit", io::positive);
        options.expected_size = expected.value_or(0);
        auto const path = read_path(file, key + "file", "STL file beside the case or in a folder there");
        if (!path || wrong({"unit", "shift", "expected_size"})) return std::nullopt;
        try {
            auto found = geometry::read_stl_solid(*path, options);
            file.note_contents(key + "file", *path);
            for (auto const& notice : found.notices) file.derived(key + "mended", notice, "on reading");
            if (!expected && !fits(found.mesh->bounds())) return std::nullopt;
            return found.mesh;
        } catch (base::CaseError const& error) {
            auto const& first = error.mistakes.front();
            auto hints = first.hints;
            for (std::size_t k = 1; k < error.mistakes.size(); ++k)
                hints.push_back("it also " + error.mistakes[k].what);
            hints.push_back(first.file.empty()
                                ? fmt::format("save the body as an STL file, ASCII or binary, of at most "
                                              "{} facets",
                                              options.stl.most_triangles)
                                : "the file is " + *path);
            // What could not be read is told with the path, what is no body to be read after the name.
            file.mistake(key + "file", first.file.empty() ? "cannot be taken: " + first.what : first.what,
                         std::move(hints));
            return std::nullopt;
        }
    }

    //! Whether a body from a file is of a size that an apparatus or a part of it may have.
    bool fits(geometry::Bounds const& box)
    {
        double const size = box.size();
        auto const wrong_unit = [&](std::string const& where, bool large) {
            file.mistake(key + (file.has(key + "unit") ? "unit" : "file"),
                         fmt::format("makes the body {:.4g} m large{}: {}", size, where,
                                     large ? "millimetres read as metres?" : "metres read as millimetres?"),
                         {fmt::format("give unit = \"{}\" if that is what the file is in, or expected_size if the body "
                                      "is so {}",
                                      large ? "mm" : "m", large ? "large" : "small")});
            return false;
        };
        if (apparatus > 0) {
            auto const where = fmt::format(", where the apparatus has {:.4g} m", apparatus);
            if (size > too_large * apparatus) return wrong_unit(where, true);
            if (size < too_small * apparatus) return wrong_unit(where, false);
        }
        return size > largest_apparatus ? wrong_unit("", true) : true;
    }

    std::optional<geometry::Solid> read()
    {
        std::vector<std::string> shapes;
        for (auto const& [name, keys] : keys_of_shape) shapes.push_back(name);
        auto const shape = file.name(key + "shape", std::nullopt, "of the body", shapes, "a shape of a body");
        auto const known = keys_of_shape.find(shape);
        for (auto const& [other, keys] : keys_of_shape)
            for (auto const& name : keys) {
                file.know(key + name);
                bool const asked = known != keys_of_shape.end() &&
                                   std::find(known->second.begin(), known->second.end(), name) != known->second.end();
                if (file.has(key + name) && !asked && known != keys_of_shape.end() && !file.wrong(key + name))
                    file.mistake(key + name, fmt::format("does not belong to shape = \"{}\"", shape));
            }
        if (known == keys_of_shape.end()) return std::nullopt;
        std::optional<geometry::Solid> out;
        if (shape == "box") out = box();
        if (shape == "cylinder") {
            auto const base = point("base", "centre of the end where it begins"), along = axis();
            double const high = length("length", "along the axis");
            out = geometry::cylinder(base, along, high, 0.5 * length("diameter", "of the cylinder"));
        }
        if (shape == "cone") out = cone();
        if (shape == "sphere") {
            auto const centre = point("centre", "of the sphere");
            out = geometry::Ball{centre, 0.5 * length("diameter", "of the sphere")};
        }
        if (shape == "tube") out = tube();
        if (shape == "profile") out = profile();
        if (shape == "stl") return mesh();
        for (auto const& name : known->second)
            if (file.wrong(key + name)) return std::nullopt;
        if (auto const wrong = geometry::fault(*out)) {
            file.mistake(key + "shape", "is no body: it " + *wrong);
            return std::nullopt;
        }
        return out;
    }
};
}

std::optional<geometry::Solid> read_solid(io::CaseFile& file, std::string const& key, double apparatus)
{
    return Reader{file, key, apparatus}.read();
}
}
