// Granules counted by classes of diameter.
#pragma once

#include <cstddef>
#include <vector>

namespace granum::population
{
struct Classes
{
    std::vector<double> edges;   //!< m, rising
    std::vector<double> number;  //!< granules of each class, spread evenly over it

    //! Equal classes from `low` to `high` m, empty.
    static Classes even(double low, double high, std::size_t count);

    std::size_t size() const { return number.size(); }
    double width(std::size_t k) const { return edges[k + 1] - edges[k]; }
    double centre(std::size_t k) const { return 0.5 * (edges[k] + edges[k + 1]); }
    //! Means over an evenly filled class: m2 of surface and m3 of volume of one granule.
    double surface(std::size_t k) const;
    double volume(std::size_t k) const;

    //! Adds `count` granules of one diameter to its class. Throws base::NumericsError beyond the classes.
    void add(double diameter, double count);

    double total() const;          //!< granules
    double total_volume() const;   //!< m3
    double total_surface() const;  //!< m2
    double mean_diameter() const;  //!< m, over numbers
    //! m, below which `share` of the volume lies, linear within classes.
    double percentile(double share) const;
};
}
