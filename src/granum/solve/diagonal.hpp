// The diagonal as a preconditioner: the plain reference.
#pragma once

#include "granum/solve/preconditioner.hpp"

#include <vector>

namespace granum::solve
{
class Diagonal : public Preconditioner
{
  public:
    explicit Diagonal(grid::Grid const& grid);

    void set_up(System const& system, Field const& diagonal, Facts const& facts) override;
    void take(std::size_t line, double const* residual) override;
    double apply() override;
    void give(std::size_t line, double* result) const override;

  private:
    std::vector<grid::Run> lines_;
    Field diagonal_, result_;
    std::vector<double> products_;  // residual times result, by line
};
}
