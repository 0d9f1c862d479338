// One cycle of a multigrid of hypre as a preconditioner; the only file pair that knows hypre.
#pragma once

#include "granum/solve/preconditioner.hpp"

namespace granum::solve
{
class Hypre : public Preconditioner
{
  public:
    //! `method`: pfmg or smg.
    Hypre(grid::Grid const& grid, par::Communicator const& comm, Method method);
    ~Hypre() override;

    //! True where hypre can treat the periodic directions of the grid.
    static bool suits(grid::Grid const& grid);

    //! Keeps an earlier set-up that still serves.
    void set_up(System const& system, Field const& diagonal, Facts const& facts) override;
    void take(std::size_t line, double const* residual) override;
    double apply() override;
    void give(std::size_t line, double* result) const override;
    void served(int iterations) override;
    Pressure::Memory const& memory() const override;
    void recall(Pressure::Memory memory) override;

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
