// The pressure equation: a symmetric seven-point system on the cells of all ranks, by preconditioned conjugate
// gradients.
//
// Four preconditioners stand behind one interface: an own geometric multigrid (multigrid.hpp), made anew in every
// solve; hypre's PFMG and SMG; and the diagonal as plain reference. The set-up of hypre's costs several of their
// cycles, and the matrix changes little from step to step: so it is kept until the iterations grow. The residual is
// always that of the present matrix.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <memory>

namespace granum::solve
{
using grid::FaceField;
using grid::Field;

//! For each owned cell c: sum over its faces of link (x_c - x_neighbour) + extra_c x_c = right_c. Links and extras are
//! not negative; a link of zero closes a face; a cell with neither is left out (x = 0). If no cell of the domain has an
//! extra, x is determined up to a constant: the mean of the right side over its cells is dropped, and x has mean zero.
struct System
{
    FaceField
        link;  //!< per lower face, filled on owned faces and on the faces shared with ghosts at n (see grid::refresh)
    Field extra;
    Field right;
    explicit System(grid::Grid const& grid)
        : link(grid.make_face_field()), extra(grid.make_field()), right(grid.make_field())
    {
    }
};

enum class Method
{
    multigrid,  //!< own
    pfmg,       //!< hypre
    smg,        //!< hypre
    diagonal
};

struct Outcome
{
    int iterations = 0;
    double residual = 0;  //!< two-norm over all ranks
    bool converged = false;
};

class Preconditioner;

class Pressure
{
  public:
    //! hypre coarsens periodic directions by two only: other periodic sizes fall back to the own multigrid.
    Pressure(grid::Grid const& grid, par::Communicator const& comm, Method method);
    ~Pressure();

    //! Solves until the residual's two-norm is below `tolerance` times that of the right side, or below `floor`. `x` is
    //! first guess and result, its ghosts are refreshed. Collective.
    Outcome solve(System const& system, Field& x, double tolerance, double floor = 0);

    Method method() const;

    //! What the next solve depends on beside its arguments: the matrix that hypre's preconditioner was made from, and
    //! how it has served since. With it recalled, a new object on the same ranks goes on with the same bits.
    struct Memory
    {
        bool set_up = false, stale = true;
        int fresh_iterations = -1, solves = 0;
        Field diagonal;  //!< empty where nothing is kept
        FaceField link;
    };
    Memory const& memory() const;
    void recall(Memory memory);  //!< Collective.

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
