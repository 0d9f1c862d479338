#include "granum/solve/diagonal.hpp"

#include <algorithm>
#include <numeric>

namespace granum::solve
{
Diagonal::Diagonal(grid::Grid const& grid)
    : lines_(grid::runs(grid, [](int, int, int, grid::Index) { return true; })),
      result_(grid.make_field()),
      products_(lines_.size())
{
}

void Diagonal::set_up(System const&, Field const& diagonal, Facts const&)
{
    diagonal_ = diagonal;
}

void Diagonal::take(std::size_t line, double const* residual)
{
    products_[line] = 0;
    for (auto c = lines_[line].first; c < lines_[line].end; ++c, ++residual) {
        result_[c] = diagonal_[c] > 0 ? *residual / diagonal_[c] : 0;
        products_[line] += *residual * result_[c];
    }
}

double Diagonal::apply()
{
    return std::accumulate(products_.begin(), products_.end(), 0.0);
}

void Diagonal::give(std::size_t line, double* result) const
{
    std::copy(result_.begin() + static_cast<std::ptrdiff_t>(lines_[line].first),
              result_.begin() + static_cast<std::ptrdiff_t>(lines_[line].end), result);
}
}
