// Geometric multigrid as a preconditioner, made anew for each matrix.
//
// Cells are paired in the directions that couple strongly, as the sums of links tell. Corrections are constant over
// the cells of a pair and links of coarse cells are those of rediscretisation; Gauss-Seidel sweeps over cells of one
// colour smooth, in reverse order after the correction, so that the cycle is symmetric. They end and begin with the
// same colour: only the other one has a residual to hand down and needs a correction. All is done in single
// precision, which halves the traffic: an approximate inverse needs no more.
//
// Each rank has the coarse cells whose first fine cell it owns. Levels of a few thousand cells are gathered and done
// by every rank alone, so that none waits for small messages. All sums are in an order that no cut among ranks
// changes: the result has the same bits on any number of ranks.
#pragma once

#include "granum/solve/preconditioner.hpp"

#include <memory>

namespace granum::solve
{
class Multigrid : public Preconditioner
{
  public:
    //! Levels of at most `few` cells of all ranks are done by every rank alone, the finest excepted.
    Multigrid(grid::Grid const& grid, par::Communicator const& comm, long few = 4096);
    ~Multigrid() override;

    void set_up(System const& system, Field const& diagonal, Facts const& facts) override;
    void take(std::size_t line, double const* residual) override;
    double apply() override;
    void give(std::size_t line, double* result) const override;

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
