// The cells along one direction of a rank: where their faces are. Cells may be stretched.
#pragma once

#include <vector>

namespace granum::grid
{
//! Cells 0 .. n-1 are owned, -1 and n are ghosts. A ghost beyond an end that is not periodic is as wide as its
//! neighbour.
class Axis
{
  public:
    Axis() = default;
    //! `faces`: of the whole direction, rising, m; this rank has `n` cells from `shift` on.
    Axis(std::vector<double> const& faces, bool periodic, int shift, int n);

    int cells() const { return static_cast<int>(faces_.size()) - 3; }
    bool uniform() const { return uniform_; }

    //! Lower face of cell i, m; i from -1 to n + 1.
    double face(int i) const { return faces_[static_cast<std::size_t>(i + 1)]; }
    double width(int i) const { return face(i + 1) - face(i); }           //!< of cell i, m
    double centre(int i) const { return 0.5 * (face(i) + face(i + 1)); }  //!< m
    double gap(int i) const { return centre(i) - centre(i - 1); }  //!< across the lower face of cell i, m; 0 .. n

    //! Cell that x (m) lies in; -1 and n stand for all that is beyond.
    int cell(double x) const;

    //! Smallest width of an owned cell, m.
    double narrowest() const;

  private:
    std::vector<double> faces_;
    bool uniform_ = true;
    double first_ = 0, per_width_ = 1, bins_per_length_ = 0;
    std::vector<int> first_in_bin_;  // cell at the lower end of each of equal parts, where cells are stretched
};
}
