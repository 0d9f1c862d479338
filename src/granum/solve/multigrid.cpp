#include "granum/solve/multigrid.hpp"

#include "granum/base/error.hpp"

#include <HYPRE.h>
#include <HYPRE_struct_ls.h>

#include <array>
#include <vector>

namespace granum::solve
{
namespace
{
//! Owned cells as hypre counts them: x fastest.
template <class Visitor>
void for_box(grid::Grid const& grid, Visitor&& visit)
{
    for (int k = 0; k < grid.n[2]; ++k)
        for (int j = 0; j < grid.n[1]; ++j)
            for (int i = 0; i < grid.n[0]; ++i) visit(grid.at(i, j, k));
}

void start_hypre_once()
{
    static bool const started = [] { return HYPRE_Init() == 0; }();
    base::require(started, "hypre does not start");
}
}

struct Multigrid::Inside
{
    grid::Grid const& grid;
    par::Communicator const& comm;
    HYPRE_StructGrid cells = nullptr;
    HYPRE_StructStencil stencil = nullptr;
    HYPRE_StructMatrix matrix = nullptr;
    HYPRE_StructVector right = nullptr, solution = nullptr;
    HYPRE_StructSolver cycle = nullptr;
    std::array<HYPRE_Int, 3> low{}, high{};
    std::vector<double> packed;

    Inside(grid::Grid const& g, par::Communicator const& c) : grid(g), comm(c)
    {
        start_hypre_once();
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = grid.shift[d];
            high[d] = grid.shift[d] + grid.n[d] - 1;
        }
        HYPRE_StructGridCreate(comm.handle(), 3, &cells);
        HYPRE_StructGridSetExtents(cells, low.data(), high.data());
        std::array<HYPRE_Int, 3> period{};
        for (std::size_t d = 0; d < 3; ++d) period[d] = grid.periodic[d] && grid.global[d] > 1 ? grid.global[d] : 0;
        HYPRE_StructGridSetPeriodic(cells, period.data());
        HYPRE_StructGridAssemble(cells);

        // Symmetric storage: the cell itself and its upper neighbours.
        HYPRE_StructStencilCreate(3, 4, &stencil);
        HYPRE_Int offsets[4][3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int entry = 0; entry < 4; ++entry) HYPRE_StructStencilSetElement(stencil, entry, offsets[entry]);

        for (HYPRE_StructVector* vector : {&right, &solution}) {
            HYPRE_StructVectorCreate(comm.handle(), cells, vector);
            HYPRE_StructVectorInitialize(*vector);
            HYPRE_StructVectorAssemble(*vector);
        }
        packed.resize(static_cast<std::size_t>(grid.n[0]) * grid.n[1] * grid.n[2] * 4);
    }
    ~Inside()
    {
        drop();
        HYPRE_StructVectorDestroy(right);
        HYPRE_StructVectorDestroy(solution);
        HYPRE_StructStencilDestroy(stencil);
        HYPRE_StructGridDestroy(cells);
    }
    Inside(Inside const&) = delete;
    Inside& operator=(Inside const&) = delete;

    void drop()
    {
        if (cycle) HYPRE_StructPFMGDestroy(cycle);
        if (matrix) HYPRE_StructMatrixDestroy(matrix);
        cycle = nullptr;
        matrix = nullptr;
    }
};

Multigrid::Multigrid(grid::Grid const& grid, par::Communicator const& comm)
    : inside_(std::make_unique<Inside>(grid, comm))
{
}
Multigrid::~Multigrid() = default;

bool Multigrid::suits(grid::Grid const& grid)
{
    for (std::size_t d = 0; d < 3; ++d)
        if (grid.periodic[d] && (grid.global[d] & (grid.global[d] - 1)) != 0) return false;
    return true;
}

void Multigrid::set_up(grid::Field const& diagonal, grid::FaceField const& link)
{
    Inside& in = *inside_;
    in.drop();
    HYPRE_StructMatrixCreate(in.comm.handle(), in.cells, in.stencil, &in.matrix);
    HYPRE_StructMatrixSetSymmetric(in.matrix, 1);
    HYPRE_StructMatrixInitialize(in.matrix);
    std::size_t next = 0;
    for_box(in.grid, [&](grid::Index cell) {
        double const own = diagonal[cell];
        in.packed[next++] = own > 0 ? own : 1;  // a cell left out stands alone
        for (std::size_t d = 0; d < 3; ++d)
            in.packed[next++] = in.grid.periodic[d] && in.grid.global[d] == 1 ? 0 : -link[d][in.grid.next(cell, d)];
    });
    HYPRE_Int entries[4]{0, 1, 2, 3};
    HYPRE_StructMatrixSetBoxValues(in.matrix, in.low.data(), in.high.data(), 4, entries, in.packed.data());
    HYPRE_StructMatrixAssemble(in.matrix);

    HYPRE_StructPFMGCreate(in.comm.handle(), &in.cycle);
    HYPRE_StructPFMGSetMaxIter(in.cycle, 1);
    HYPRE_StructPFMGSetTol(in.cycle, 0.0);
    HYPRE_StructPFMGSetZeroGuess(in.cycle);
    // Symmetric, as conjugate gradients ask: red-black, but weighted Jacobi in a periodic box, whose coarsest cells are
    // their own neighbours and have no two colours: red-black does not converge there.
    bool const wraps = in.grid.periodic[0] || in.grid.periodic[1] || in.grid.periodic[2];
    HYPRE_StructPFMGSetRelaxType(in.cycle, wraps ? 1 : 2);
    HYPRE_StructPFMGSetRAPType(in.cycle, 0);
    HYPRE_StructPFMGSetSkipRelax(in.cycle, 1);
    HYPRE_StructPFMGSetNumPreRelax(in.cycle, 1);
    HYPRE_StructPFMGSetNumPostRelax(in.cycle, 1);
    HYPRE_StructPFMGSetPrintLevel(in.cycle, 0);
    HYPRE_StructPFMGSetLogging(in.cycle, 0);
    HYPRE_StructPFMGSetup(in.cycle, in.matrix, in.right, in.solution);
    HYPRE_ClearAllErrors();
}

void Multigrid::apply(grid::Field const& from, grid::Field& to)
{
    Inside& in = *inside_;
    std::size_t next = 0;
    for_box(in.grid, [&](grid::Index cell) { in.packed[next++] = from[cell]; });
    HYPRE_StructVectorSetBoxValues(in.right, in.low.data(), in.high.data(), in.packed.data());
    HYPRE_StructVectorSetConstantValues(in.solution, 0.0);
    HYPRE_StructPFMGSolve(in.cycle, in.matrix, in.right, in.solution);
    HYPRE_ClearAllErrors();  // one cycle never "converges"; the outer iteration judges
    HYPRE_StructVectorGetBoxValues(in.solution, in.low.data(), in.high.data(), in.packed.data());
    next = 0;
    for_box(in.grid, [&](grid::Index cell) { to[cell] = in.packed[next++]; });
}
}
