#include "granum/io/vtk.hpp"

#include "granum/base/error.hpp"
#include "granum/io/base64.hpp"
#include "granum/io/text_file.hpp"
#include "granum/math/constants.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace granum::io
{
namespace
{
//! Name as an XML attribute.
std::string attribute(std::string const& text)
{
    std::string out;
    for (char const letter : text) {
        if (letter == '&')
            out += "&amp;";
        else if (letter == '<')
            out += "&lt;";
        else if (letter == '"')
            out += "&quot;";
        else
            out += letter;
    }
    return out;
}

//! The bytes of one array as VTK reads them with vtkZLibDataCompressor: base64 of the header (number of blocks, size of
//! a block, size of a partial last block, compressed size of each), then base64 of the compressed blocks.
std::string compressed(std::span<std::byte const> bytes)
{
    constexpr std::size_t block = 32768;
    std::size_t const blocks = (bytes.size() + block - 1) / block;
    std::vector<std::uint64_t> header{blocks, blocks > 0 ? block : 0, bytes.size() % block};
    std::vector<std::byte> packed;
    for (std::size_t b = 0; b < blocks; ++b) {
        auto const part = bytes.subspan(b * block, std::min(block, bytes.size() - b * block));
        uLongf size = compressBound(part.size());
        std::size_t const start = packed.size();
        packed.resize(start + size);
        int const status = compress2(reinterpret_cast<Bytef*>(packed.data() + start), &size,
                                     reinterpret_cast<Bytef const*>(part.data()), part.size(), 1);
        base::require(status == Z_OK, "zlib could not compress {} bytes", part.size());
        packed.resize(start + size);
        header.push_back(size);
    }
    return base64(std::as_bytes(std::span(header))) + base64(packed);
}

template <class Number>
std::string data_array(std::string const& name, char const* type, int components, std::vector<Number> const& numbers)
{
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}\n</DataArray>\n", type,
        attribute(name), components, compressed(std::as_bytes(std::span(numbers))));
}

std::string data_array(NamedArray const& array)
{
    if (array.precision == Precision::twice) return data_array(array.name, "Float64", array.components, array.values);
    std::vector<float> const shorter(array.values.begin(), array.values.end());
    return data_array(array.name, "Float32", array.components, shorter);
}

std::string section(char const* name, std::vector<NamedArray> const& arrays, std::size_t rows)
{
    std::string out = fmt::format("<{}>\n", name);
    for (auto const& array : arrays) {
        base::require(array.values.size() == rows * static_cast<std::size_t>(array.components),
                      "array \"{}\" has {} values, not {} rows of {}", array.name, array.values.size(), rows,
                      array.components);
        out += data_array(array);
    }
    return out + fmt::format("</{}>\n", name);
}

std::string points(std::span<Vec3 const> positions)
{
    std::vector<float> numbers;
    numbers.reserve(3 * positions.size());
    for (auto const& x : positions)
        for (std::size_t i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(x[i]));
    return "<Points>\n" + data_array("points", "Float32", 3, numbers) + "</Points>\n";
}

//! `body` inside the outer elements every file has.
std::string document(char const* type, std::string const& body)
{
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n{1}</VTKFile>\n",
        type, body);
}
}

void write_points(std::string const& path, std::span<Vec3 const> positions, std::vector<NamedArray> const& arrays)
{
    std::size_t const rows = positions.size();
    std::vector<std::int64_t> connectivity(rows), offsets(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        connectivity[row] = static_cast<std::int64_t>(row);
        offsets[row] = static_cast<std::int64_t>(row + 1);
    }
    std::string body = fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\">\n", rows);
    body += section("PointData", arrays, rows);
    body += points(positions);
    body += "<Verts>\n" + data_array("connectivity", "Int64", 1, connectivity) +
            data_array("offsets", "Int64", 1, offsets) + "</Verts>\n</Piece>\n</PolyData>\n";
    replace_text(path, document("PolyData", body));
}

void write_cells(std::string const& path, std::array<std::vector<double>, 3> const& lines,
                 std::vector<NamedArray> const& arrays)
{
    std::size_t rows = 1;
    for (auto const& faces : lines) rows *= faces.size() - 1;
    std::string const extent =
        fmt::format("0 {} 0 {} 0 {}", lines[0].size() - 1, lines[1].size() - 1, lines[2].size() - 1);
    std::string body = fmt::format("<RectilinearGrid WholeExtent=\"{0}\">\n<Piece Extent=\"{0}\">\n", extent);
    body += section("CellData", arrays, rows) + "<Coordinates>\n";
    constexpr std::array names{"x [m]", "y [m]", "z [m]"};
    for (std::size_t d = 0; d < 3; ++d) body += data_array(names[d], "Float64", 1, lines[d]);
    body += "</Coordinates>\n</Piece>\n</RectilinearGrid>\n";
    replace_text(path, document("RectilinearGrid", body));
}

Surface chamber_surface(geometry::Chamber const& chamber, int segments)
{
    Surface out;
    if (chamber.shape == geometry::Chamber::Shape::box) {
        for (int corner = 0; corner < 8; ++corner)
            out.corners.push_back(
                {corner & 1 ? chamber.size.x : 0, corner & 2 ? chamber.size.y : 0, corner & 4 ? chamber.size.z : 0});
        out.faces = {{0, 2, 3, 1}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        return out;
    }
    for (auto const& point : chamber.profile)
        for (int s = 0; s < segments; ++s) {
            double const angle = 2 * math::pi * s / segments;
            out.corners.push_back({point.radius * std::cos(angle), point.radius * std::sin(angle), point.height});
        }
    std::vector<int> plate;
    for (int s = segments; s-- > 0;) plate.push_back(s);
    out.faces.push_back(plate);
    for (int ring = 0; ring + 1 < std::ssize(chamber.profile); ++ring)
        for (int s = 0; s < segments; ++s) {
            int const low = ring * segments, high = low + segments, next = (s + 1) % segments;
            out.faces.push_back({low + s, low + next, high + next, high + s});
        }
    return out;
}

void write_surface(std::string const& path, Surface const& surface)
{
    std::vector<std::int64_t> connectivity, offsets;
    for (auto const& face : surface.faces) {
        connectivity.insert(connectivity.end(), face.begin(), face.end());
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    std::string body = fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n",
                                   surface.corners.size(), surface.faces.size());
    body += points(surface.corners);
    body += "<Polys>\n" + data_array("connectivity", "Int64", 1, connectivity) +
            data_array("offsets", "Int64", 1, offsets) + "</Polys>\n</Piece>\n</PolyData>\n";
    replace_text(path, document("PolyData", body));
}

void Collection::add(double time, std::string const& file)
{
    entries_ += fmt::format("<DataSet timestep=\"{:.12g}\" part=\"0\" file=\"{}\"/>\n", time, attribute(file));
    write();
}

void Collection::go_on(std::string entries)
{
    entries_ = std::move(entries);
    if (!entries_.empty()) write();
}

void Collection::write() const
{
    replace_text(path_, document("Collection", "<Collection>\n" + entries_ + "</Collection>\n"));
}
}
