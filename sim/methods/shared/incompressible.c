#include "sim/methods/shared/incompressible.h"

#include "shaders/sim/shared/share_most.h"
#include "sim/def/fluids.h"

#include <math.h>

typedef struct WaveSums {
    double sum[3], squares;
} WaveSums;

/* Sums for a wave with phase `wave` per spacing. */
static WaveSums wave_sums(const Kernel *kernel, int dimensions, double spacing, double h,
                          const double wave[3])
{
    const int reach = (int)ceil(h / spacing), deep = dimensions == 3 ? reach : 0;
    WaveSums s = {0};
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= h)
                    continue;
                const double slope = -kernel->derivative(r, h);
                const double part = slope / r * spacing * sin(wave[0] * i + wave[1] * j + wave[2] * k);
                s.sum[0] += part * i, s.sum[1] += part * j, s.sum[2] += part * k;
                s.squares += slope * slope;
            }
    return s;
}

/* For a lattice with the given spacing and support radius h, m. */
static JacobiLattice jacobi_lattice(const Kernel *kernel, int dimensions, double spacing, double h)
{
    enum { WAVES = 12 };
    JacobiLattice lattice = {0};
    for (int i = 0; i <= WAVES; i++)
        for (int j = 0; j <= i; j++)
            for (int k = 0; k <= (dimensions == 3 ? j : 0); k++) {
                const double wave[3] = {M_PI * i / WAVES, M_PI * j / WAVES, M_PI * k / WAVES};
                const WaveSums s = wave_sums(kernel, dimensions, spacing, h, wave);
                const double *x = s.sum;
                lattice.squares = s.squares;
                lattice.greatest =
                    fmax(lattice.greatest, (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / s.squares);
            }
    return lattice;
}

/* Sums over half a lattice, the rows at and below a particle: W over the whole lattice's, and the slope of
   sum W, unscaled. */
static void half_lattice(const Kernel *kernel, int dimensions, double spacing, double h, double *part,
                         double *slope)
{
    const int reach = (int)ceil(h / spacing), deep = dimensions == 3 ? reach : 0;
    double whole = 0, below = 0;
    *slope = 0;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (r >= h)
                    continue;
                whole += kernel->value(r, h);
                if (j > 0)
                    continue;
                below += kernel->value(r, h);
                *slope += r > 0 ? kernel->derivative(r, h) / r * spacing * j : 0;
            }
    *part = below / whole;
}

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

/* f(q) = -w'(q) / q at q = 0.5, as in sim/cpu/pair_loop.h. */
static double shape_half(void)
{
    return INCOMPRESSIBLE_KERNEL == KERNEL_CUBIC ? 3 : 2.5;
}

/* With momentum m Jacobi's method is stable below 2 (1 + m) over the greatest eigenvalue (Polyak 1964);
   disordered fluid has greater eigenvalues than the lattice, by up to a half. */
static const double RELAXATION = 1.8;

/* Lower bound of D, over D on the lattice: else particles with few neighbours or on a wall would be
   thrown. */
static const double SQUARES_LEAST = 0.1;

IncompressibleFactors incompressible_factors(const WorldDef *def, const Constants *constants,
                                             const IncompressibleFactors *kept)
{
    if (kept->relaxation > 0)
        return *kept;
    const Lattice *lattice = &constants->lattice;
    const Kernel *kernel = &shape_kernels[INCOMPRESSIBLE_KERNEL];
    const double h = def->support * def->spacing, r = 0.5 * h;
    const double unit = constants->unit_volume, slope = -unit * kernel->derivative(r, h) / r / shape_half();
    const double n0 = unit * lattice->number_density, scale = lattice->density_scale;
    const JacobiLattice jacobi = jacobi_lattice(kernel, def->dimensions, def->spacing, h);
    double part, surface_slope;
    half_lattice(kernel, def->dimensions, def->spacing, h, &part, &surface_slope);
    return (IncompressibleFactors){
        .gradient = (float)(slope * scale),
        .friction_gradient = (float)(slope * lattice->gradient_scale),
        .relaxation = (float)(RELAXATION / jacobi.greatest),
        .pressure_of_term = (float)(n0 * n0 * scale / lattice->gradient_scale),
        .least_squares = (float)(SQUARES_LEAST * scale * scale * unit * unit * jacobi.squares),
        .surface_lack = (float)(1 - part),
        .surface_slope = (float)(scale * unit * surface_slope),
    };
}

double incompressible_rest_residual(const Substep *step, double dt, double part, double still, double allowed)
{
    static const double CALM_LEAST = 1e-6;
    const double h = (double)step->constants->support_radius, courant = step->speed * dt / h;
    const float *g = step->gravity;
    const double falls = dt * dt / h * sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
    if (falls == 0)
        return allowed;
    return fmin(allowed, fmax(fmax(fmin(part * falls, still), part * courant * courant), CALM_LEAST));
}

double incompressible_fall(const WorldDef *def)
{
    const double *g = def->gravity, h = def->support * def->spacing;
    return sqrt(h * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
}

/* With 2 to 40 fluid beside solids comes to rest. */
static const double BOUNDARY_FADES = 4;

double incompressible_boundary_fades(const WorldDef *def)
{
    return incompressible_fall(def) / (BOUNDARY_FADES * def->support * def->spacing);
}

bool incompressible_has_solids(const Constants *constants)
{
    return constants->solid_count > 0;
}

/* Greatest share of a solid among a particle's neighbours: for fluid between two solids. */
static float share_of(const float *column, size_t i)
{
    return fminf(fmaxf(column[i], 0), SHARE_MOST); /* below 0 by rounding */
}

/* SOLID_SLOPE and its length. */
static float slope_of(float *const *solid, size_t i, float s[3])
{
    for (int k = 0; k < 3; k++)
        s[k] = solid[SOLID_SLOPE + k][i];
    return sqrtf(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
}

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void solid_push(float *const *solid, size_t i, float push, float a[3], float by[3])
{
    const float share = share_of(solid[SOLID_SHARE], i), more = share / (1 - share);
    float s[3];
    const float size = slope_of(solid, i, s);
    for (int k = 0; k < 3; k++) {
        a[k] += push * s[k];
        by[k] = 2 * push * s[k];
    }
    if (size == 0)
        return;
    const float across = dot(a, s) / (size * size);
    for (int k = 0; k < 3; k++) {
        const float along = more * (a[k] - across * s[k]);
        a[k] += along;
        by[k] += along;
    }
}

void solid_hold(float *const *solid, size_t i, const float g[3], float part, float a[3])
{
    float s[3];
    const float size = slope_of(solid, i, s), share = part * share_of(solid[SOLID_LIFT], i);
    const float held = size > 0 ? share * dot(g, s) / (size * size) : 0;
    for (int k = 0; k < 3; k++)
        a[k] = -held * s[k];
}

/* F of the pair. */
static float slope(const SolidPair *pair, double scale)
{
    return cpu_slope(&shape_kernels[INCOMPRESSIBLE_KERNEL], pair, scale);
}

void incompressible_by_solid(const SolidPair *pair, float *const *solid, float scale, float force[3])
{
    const Constants *constants = pair->cpu->constants;
    const size_t i = pair->i;
    float s[3];
    const float size = slope_of(solid, i, s), mass = constants->mass[pair->cpu->now.fluid[i]];
    const float f = slope(pair, constants->lattice.density_scale) * dot(s, pair->d);
    const float part = size > 0 ? scale * mass * f / (size * size) : 0;
    for (int k = 0; k < 3; k++)
        force[k] = part * solid[SOLID_BY + k][i];
}

void incompressible_rub(const SolidPair *pair, const float u[3], float force[3])
{
    const Constants *s = pair->cpu->constants;
    const float *volume = pair->cpu->now.volume;
    const float drag = s->rubs ? slope(pair, s->lattice.gradient_scale) * volume[pair->i] * pair->volume *
                                     cpu_pair_viscosity(pair)
                               : 0;
    for (int axis = 0; axis < 3; axis++)
        force[axis] = drag * u[axis];
}
