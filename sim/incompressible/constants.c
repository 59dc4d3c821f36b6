#include "sim/incompressible/constants.h"

#include "sim/kernel/jacobi.h"
#include "sim/matter/viscosity.h"

MethodKernels incompressible_kernels(const WorldDef *def)
{
    (void)def;
    return (MethodKernels){&shape_kernels[INCOMPRESSIBLE_KERNEL], &shape_kernels[INCOMPRESSIBLE_KERNEL]};
}

StepFriction incompressible_friction(const WorldDef *def, const Lattice *lattice)
{
    return (StepFriction){
        .laminar = friction_rate(lattice, def->spacing, FRICTION_MORRIS, def->support * def->spacing, NULL),
        .walls = DRAG_MORRIS};
}

/* f(q) = -w'(q) / q at q = 0.5, as in sim/cpu/pair_shape.h. */
static double shape_half(void)
{
    return INCOMPRESSIBLE_KERNEL == KERNEL_CUBIC ? 3 : 2.5;
}

/* With momentum m Jacobi's method is stable below 2 (1 + m) over the greatest eigenvalue (Polyak 1964);
   disordered fluid has greater eigenvalues than the lattice, by up to a half. */
static const double RELAXATION = 1.8;

/* Lower bound of D, over D on the lattice: else particles with few neighbours or on a wall would be
   thrown. */
static const double LEAST = 0.1;

IncompressibleFactors incompressible_factors(const WorldDef *def, const Constants *constants)
{
    const Lattice *lattice = &constants->lattice;
    const Kernel *kernel = &shape_kernels[INCOMPRESSIBLE_KERNEL];
    const double h = def->support * def->spacing, r = 0.5 * h;
    const double unit = constants->unit_volume, slope = -unit * kernel->derivative(r, h) / r / shape_half();
    const double n0 = unit * lattice->number_density, scale = lattice->density_scale;
    const JacobiLattice jacobi = jacobi_lattice(kernel, def->dimensions, def->spacing, h);
    return (IncompressibleFactors){
        .gradient = (float)(slope * scale),
        .friction_gradient = (float)(slope * lattice->gradient_scale),
        .relaxation = (float)(RELAXATION / jacobi.greatest),
        .pressure_of_term = (float)(n0 * n0 * scale / lattice->gradient_scale),
        .least_squares = (float)(LEAST * scale * scale * unit * unit * jacobi.squares),
    };
}
