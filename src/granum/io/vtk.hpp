// Files for ParaView: VTK XML with inline base64 data, compressed by zlib.
//
// Inline, never appended: the VTK of current distributions refuses files with an appended section, because its XML
// parser stops there (VTK issue 19258).
#pragma once

#include "granum/geometry/chamber.hpp"
#include "granum/math/vec3.hpp"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace granum::io
{
using math::Vec3;

enum class Precision
{
    single,
    twice
};  //!< Float32 for what is looked at, Float64 for what is computed with

//! Values of points or cells, row after row.
struct NamedArray
{
    std::string name;  //!< with its unit, as ParaView shows it: "temperature [K]"
    std::vector<double> values;
    int components = 1;
    Precision precision = Precision::single;
};

//! Points (granules, droplets) as vertices, with one row of each array per point (.vtp). Positions in m.
//! Throws base::IoError if the file cannot be written, base::NumericsError if an array has another number of rows.
void write_points(std::string const& path, std::span<Vec3 const> positions, std::vector<NamedArray> const& arrays);

//! A box of cells between the faces `lines` (m) along x, y and z, x fastest, with one row of each array per cell
//! (.vtr).
void write_cells(std::string const& path, std::array<std::vector<double>, 3> const& lines,
                 std::vector<NamedArray> const& arrays);

//! Polygons that share corners.
struct Surface
{
    std::vector<Vec3> corners;            //!< m
    std::vector<std::vector<int>> faces;  //!< rows of `corners`, in order around the face
};

//! Plate and side walls of the chamber; the outlet is left open so that one can look in.
//! @param segments flat pieces around a body of revolution
Surface chamber_surface(geometry::Chamber const& chamber, int segments = 96);

void write_surface(std::string const& path, Surface const& surface);

//! A time series of files (.pvd), complete and readable after every `add`.
class Collection
{
  public:
    explicit Collection(std::string path) : path_(std::move(path)) {}
    //! @param time s
    //! @param file relative to the folder of the collection
    void add(double time, std::string const& file);

    //! @{ The entries so far, and a series that goes on from there: the file holds these and no others.
    std::string const& entries() const { return entries_; }
    void go_on(std::string entries);
    //! @}

  private:
    void write() const;

    std::string path_;
    std::string entries_;
};
}
