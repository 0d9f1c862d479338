// One PFMG cycle of hypre as a preconditioner; the only file pair that knows hypre.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <memory>

namespace granum::solve
{
class Multigrid
{
  public:
    Multigrid(grid::Grid const& grid, par::Communicator const& comm);
    ~Multigrid();

    //! True where hypre can treat the periodic directions of the grid.
    static bool suits(grid::Grid const& grid);

    //! Takes over the matrix given by diagonal and links (see System). Collective.
    void set_up(grid::Field const& diagonal, grid::FaceField const& link);

    //! to := one V-cycle on `from`, from a zero guess: a fixed symmetric positive operator. Collective.
    void apply(grid::Field const& from, grid::Field& to);

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
