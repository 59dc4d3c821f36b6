/* Derived scalars and vectors: linear fields on a lattice, scattered particles against sums over all in
   double precision, two dimensions, periodic sides, non-finite numbers; and no particles. */
#include "tests/render/fixture.h"

#include "render/particles/particles.h"

enum { ALL = 6000 };

/* A test's particles, and the result. */
typedef struct Cloud {
    ParticleBuffers state;
    DerivedSpace space;
    float position[4 * ALL], velocity[4 * ALL], density[ALL], pressure[ALL], three[3][ALL];
    float scalar[SCALAR_COUNT][ALL], vector[VECTOR_COUNT][4 * ALL];
    double slowest;      /* m/s */
    bool all_foam;       /* all particles have old foam */
    float foam[2 * ALL]; /* of derived_foam: turbulence of particles at least as fast; old foam seen */
} Cloud;

static void add(Cloud *cloud, double x, double y, double z, double volume)
{
    const size_t i = cloud->state.count++;
    assert_true(i < ALL);
    memcpy(cloud->position + 4 * i, (float[4]){(float)x, (float)y, (float)z, (float)volume}, 16);
    cloud->density[i] = 1000, cloud->pressure[i] = 0;
}

/* A filled box with the given number of places per axis; a single layer: two dimensions. */
static Cloud *lattice(int nx, int ny, int nz, double spacing, double support)
{
    Cloud *cloud = calloc(1, sizeof *cloud);
    assert_non_null(cloud);
    cloud->state = (ParticleBuffers){.spacing = spacing,
                                     .support_radius = support * spacing,
                                     .box_size = {nx * spacing, ny * spacing, nz * spacing},
                                     .box = {.orientation = {0, 0, 0, 1}}};
    cloud->space.flat = nz == 1;
    for (int i = 0; i < nx * ny * nz; i++)
        add(cloud, (i % nx + 0.5 - 0.5 * nx) * spacing, (i / nx % ny + 0.5) * spacing,
            (i / nx / ny + 0.5 - 0.5 * nz) * spacing, pow(spacing, nz == 1 ? 2 : 3));
    return cloud;
}

static double number(unsigned *seed)
{
    *seed = *seed * 1664525 + 1013904223;
    return (double)(*seed >> 8) / (1 << 24);
}

/* Particles anywhere in a box, with any velocities, densities and pressures. */
static Cloud *scattered(int count, double spacing, bool flat)
{
    const int side = flat ? (int)sqrt(count) : (int)cbrt(count);
    Cloud *cloud = lattice(side, side, flat ? 1 : side, spacing, 2.1);
    unsigned seed = 7;
    for (size_t i = 0; i < cloud->state.count; i++) {
        for (int k = 0; k < 3; k++) {
            const double low = k == 1 ? 0 : -0.5 * cloud->state.box_size[k];
            if (!flat || k < 2)
                cloud->position[4 * i + (size_t)k] = (float)(low + number(&seed) * cloud->state.box_size[k]);
            cloud->velocity[4 * i + (size_t)k] = flat && k == 2 ? 0 : (float)(2 * number(&seed) - 1);
        }
        cloud->position[4 * i + 3] *= (float)(0.8 + 0.4 * number(&seed));
        cloud->density[i] = (float)(900 + 200 * number(&seed));
        cloud->pressure[i] = (float)(1000 * number(&seed) - 200);
    }
    return cloud;
}

/* v = turn x r + expansion r + (3, -2, 1) */
static void set_linear(Cloud *cloud, const double turn[3], double expansion)
{
    for (size_t i = 0; i < cloud->state.count; i++) {
        const float *x = cloud->position + 4 * i;
        const double r[3] = {x[0], x[1], x[2]}, base[3] = {3, -2, 1};
        double turned[3];
        cross_product(turn, r, turned);
        for (int k = 0; k < 3; k++)
            cloud->velocity[4 * i + (size_t)k] =
                (float)((cloud->space.flat && k == 2 ? 0 : base[k] + expansion * r[k]) + turned[k]);
    }
}

static void read_back(const ParticleAttribute *from, size_t count, float *to)
{
    if (from->buffer)
        glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * from->stride), to);
}

/* All existing scalars and vectors. */
static void derive(Cloud *cloud)
{
    const ParticleWants wants = {
        .scalars = SCALAR_BIT(SCALAR_COUNT) - 1, .vectors = VECTOR_BIT(VECTOR_COUNT) - 1, .foam = true};
    const size_t count = cloud->state.count;
    Error error = {0};
    ParticleBuffers particles;
    Derived derived = {0};
    ParticleArrays arrays = {.position = cloud->position, .velocity = cloud->velocity};
    arrays.scalar[SCALAR_DENSITY] = cloud->density;
    arrays.scalar[SCALAR_PRESSURE] = cloud->pressure;
    for (int k = 0; k < 3; k++)
        arrays.scalar[SCALAR_ACCELERATION_X + k] = arrays.scalar[SCALAR_FRICTION_BEFORE_X + k] =
            cloud->three[k];
    arrays.scalar[SCALAR_BORN] = cloud->three[0];
    assert_int_equal(particle_wants_attributes(&wants), PARTICLE_SCALAR(SCALAR_STATE_COUNT) - 1 -
                                                            PARTICLE_SCALAR(SCALAR_FLUID) +
                                                            PARTICLE_VELOCITY + PARTICLE_FLUID + PARTICLE_ID);
    Upload *upload = upload_create(
        count,
        PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_DENSITY) | PARTICLE_SCALAR(SCALAR_PRESSURE) |
            PARTICLE_SCALAR(SCALAR_BORN) |
            7U * (PARTICLE_SCALAR(SCALAR_ACCELERATION_X) | PARTICLE_SCALAR(SCALAR_FRICTION_BEFORE_X)),
        &error);
    assert_true(upload && upload_write_arrays(upload, &arrays, &cloud->state, &error));
    assert_true(upload_take(upload, &particles));
    if (!derived_update(&derived, &wants, &error))
        fail_msg("%s", error.message);
    for (int run = 0; run < 2; run++) {
        assert_true(upload_take(upload, &particles));
        derived_fill(&derived, &wants, &cloud->space, &particles);
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int s = SCALAR_STATE_COUNT; s < SCALAR_COUNT; s++) {
        assert_true(particles.scalar[s].buffer || count == 0);
        read_back(&particles.scalar[s], count, cloud->scalar[s]);
    }
    for (int v = 0; v < VECTOR_COUNT; v++) {
        assert_true(particles.vector[v].buffer || count == 0);
        read_back(&particles.vector[v], count, cloud->vector[v]);
    }
    static const float one = 1;
    GLuint old = 0;
    if (cloud->all_foam) {
        work_buffer_remake(&old, count * sizeof one, "old foam");
        glClearNamedBufferData(old, GL_R32F, GL_RED, GL_FLOAT, &one);
    }
    const ParticleAttribute foam = derived_foam(&derived, &cloud->space, &particles, cloud->slowest, old);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    read_back(&foam, count, cloud->foam);
    glDeleteBuffers(1, &old);
    read_back(&particles.scalar[SCALAR_TRAPPED_AIR], count,
              cloud->scalar[SCALAR_TRAPPED_AIR]); /* unchanged */
    derived_destroy(&derived);
    upload_destroy(upload);
}

/* The worst difference from `wanted`; NaN counts. */
static double off(const float *values, size_t stride, size_t count, double wanted)
{
    double worst = 0;
    for (size_t i = 0; i < count; i++)
        if (!(fabs((double)values[stride * i] - wanted) <= worst))
            worst = fabs((double)values[stride * i] - wanted);
    return worst;
}

/* At walls, edges and corners as inside. */
static void a_rigid_rotation_has_twice_its_rate(void **state)
{
    (void)state;
    const double turn[3] = {1.5, -2, 0.7}, size = sqrt(1.5 * 1.5 + 4 + 0.49);
    Cloud *cloud = lattice(14, 11, 9, 0.05, 2.1);
    set_linear(cloud, turn, 0);
    derive(cloud);
    const size_t count = cloud->state.count;
    assert_true(off(cloud->scalar[SCALAR_VORTICITY], 1, count, 2 * size) < 1e-4);
    assert_true(off(cloud->scalar[SCALAR_DIVERGENCE], 1, count, 0) < 1e-4);
    for (int k = 0; k < 3; k++)
        assert_true(off(cloud->vector[VECTOR_VORTICITY] + k, 4, count, 2 * turn[k]) < 1e-4);
    free(cloud);
}

/* v_x = rate y: |S| = rate; and v = e r: |S| = sqrt(2 d) e, in d dimensions. */
static void strain_and_eddies(void **state)
{
    (void)state;
    const double none[3] = {0}, rate = 3, spacing = 0.05;
    for (int flat = 0; flat < 2; flat++)
        for (int shear = 0; shear < 2; shear++) {
            Cloud *cloud = lattice(14, 11, flat ? 1 : 9, spacing, 2.1);
            const size_t count = cloud->state.count;
            const double strain = shear ? rate : rate * sqrt(flat ? 4 : 6), width = 0.12 * spacing;
            set_linear(cloud, none, shear ? 0 : rate);
            for (size_t i = 0; shear && i < count; i++)
                cloud->velocity[4 * i] = (float)(rate * cloud->position[4 * i + 1]);
            derive(cloud);
            assert_true(off(cloud->scalar[SCALAR_STRAIN_RATE], 1, count, strain) < 2e-4);
            assert_true(off(cloud->scalar[SCALAR_EDDY_VISCOSITY], 1, count, width * width * strain) <
                        2e-4 * width * width * strain);
            free(cloud);
        }
}

static void an_expansion_has_no_vorticity(void **state)
{
    (void)state;
    const double still[3] = {0};
    Cloud *cloud = lattice(10, 10, 10, 0.02, 2.6);
    set_linear(cloud, still, 0.8);
    derive(cloud);
    assert_true(off(cloud->scalar[SCALAR_DIVERGENCE], 1, cloud->state.count, 2.4) < 1e-4);
    assert_true(off(cloud->scalar[SCALAR_VORTICITY], 1, cloud->state.count, 0) < 1e-4);
    free(cloud);
}

static void in_two_dimensions_the_vorticity_has_a_sign(void **state)
{
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        const double turn[3] = {0, 0, 3 * sign};
        Cloud *cloud = lattice(25, 18, 1, 0.04, 2.6);
        set_linear(cloud, turn, 0.5);
        derive(cloud);
        assert_true(off(cloud->scalar[SCALAR_VORTICITY], 1, cloud->state.count, 6 * sign) < 1e-4);
        assert_true(off(cloud->scalar[SCALAR_DIVERGENCE], 1, cloud->state.count, 1) < 1e-4);
        free(cloud);
    }
}

static void a_linear_pressure_has_its_gradient(void **state)
{
    (void)state;
    const double slope[3] = {120, -9810, 40};
    Cloud *cloud = lattice(9, 12, 8, 0.05, 2.1);
    for (size_t i = 0; i < cloud->state.count; i++)
        for (int k = 0; k < 3; k++)
            cloud->pressure[i] += (float)(slope[k] * (double)cloud->position[4 * i + (size_t)k]);
    derive(cloud);
    for (int k = 0; k < 3; k++)
        assert_true(off(cloud->vector[VECTOR_PRESSURE_GRADIENT] + k, 4, cloud->state.count, slope[k]) < 0.1);
    free(cloud);
}

/* For fluid converging at the rate a, the mean of (1 - cos) |v| is 2 a times the mean distance; W weighs
   the distance to 0.6 h. Diverging fluid gives zero, and a rigid rotation gives pi/4 of the half. */
static void trapped_air_is_that_of_smooth_flows(void **state)
{
    (void)state;
    const double still[3] = {0}, turn[3] = {0, 3, 0}, h = 4 * 0.02;
    const size_t middle = 5 * 11 * 11 + 5 * 11 + 5;
    for (int flow = -1; flow <= 1; flow++) {
        Cloud *cloud = lattice(11, 11, 11, 0.02, 4);
        set_linear(cloud, flow == 0 ? turn : still, flow);
        derive(cloud);
        const double wanted = flow < 0 ? 2 * 0.6 * h : flow == 0 ? 3 * 0.6 * h * M_PI / 4 : 0;
        const double found = (double)cloud->scalar[SCALAR_TRAPPED_AIR][middle];
        printf("trapped air %.5g, in a continuum %.5g m/s\n", found, wanted);
        assert_true(fabs(found - wanted) <= 0.03 * wanted + 1e-6);
        free(cloud);
    }
}

/* A particle approaches a second particle, with a symmetric result; when receding the result is zero. */
static void two_that_meet_trap_air(void **state)
{
    (void)state;
    for (int away = 0; away < 2; away++) {
        Cloud *cloud = lattice(2, 1, 1, 0.05, 2.1);
        cloud->space.flat = false;
        for (size_t i = 0; i < 2; i++)
            cloud->position[4 * i + 3] = 0.05F * 0.05F * 0.05F;
        cloud->velocity[0] = away ? -2 : 2;
        derive(cloud);
        const double w = (1 - 1 / 2.1) * 3 / M_PI / (2.1 * 2.1 * 2.1);
        for (size_t i = 0; i < 2; i++)
            assert_true(fabs((double)cloud->scalar[SCALAR_TRAPPED_AIR][i] - (away ? 0 : 2 * 2 * w)) < 1e-6);
        free(cloud);
    }
}

/* Slow fluid in a tank, and a drop above: old foam is seen on the top and nowhere else. */
static void old_foam_is_seen_on_the_surface(void **state)
{
    (void)state;
    Cloud *cloud = lattice(8, 8, 8, 0.05, 2.1);
    const size_t drop = 4 + 8 * 7 + 64 * 4; /* a particle of the top layer is lifted */
    cloud->state.box_size[1] *= 2;
    cloud->position[4 * drop + 1] += 0.3F;
    cloud->slowest = 1;
    for (int foam = 0; foam < 2; foam++) {
        cloud->all_foam = foam == 1;
        derive(cloud);
        for (size_t i = 0; i < cloud->state.count; i++) {
            const size_t layer = i / 8 % 8;
            const float seen = cloud->foam[2 * i + 1];
            assert_true(cloud->foam[2 * i] == 0);
            if (i == drop - 8) /* below the place that the drop has left */
                continue;
            assert_true(layer == 7 && i != drop && foam == 1 ? seen > 0.99F : seen == 0);
        }
    }
    free(cloud);
}

/* ---- against sums over all ---- */

/* The inverse by cofactors. */
static void invert(double m[3][3], double out[3][3], double *determinant)
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
            out[b][a] = m[a1][b1] * m[a2][b2] - m[a1][b2] * m[a2][b1];
        }
    *determinant = m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
    for (int a = 0; a < 9; a++)
        out[a / 3][a % 3] /= *determinant;
}

/* Of particle i by the definition; d across periodic sides by the nearest image. */
typedef struct Reference {
    double curl[3], divergence, slope[3], neighbours, trapped, turbulence;
} Reference;

static double apart(const Cloud *cloud, size_t i, size_t j, double d[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        const double size = cloud->state.box_size[k];
        d[k] = (double)cloud->position[4 * j + (size_t)k] - (double)cloud->position[4 * i + (size_t)k];
        if (cloud->space.periodic[k])
            d[k] -= size * round(d[k] / size);
        square += d[k] * d[k];
    }
    return sqrt(square);
}

/* Ihmsen et al. 2012, equation 2, over what W sums up to where there is fluid all around. */
static double trapped_by(const Cloud *cloud, size_t i, size_t j, const double d[3], double r)
{
    const double h = cloud->state.support_radius, room = M_PI / 3 * pow(h, cloud->space.flat ? 2 : 3);
    double speed2 = 0, along = 0;
    for (size_t k = 0; k < 3; k++) {
        const double v = (double)cloud->velocity[4 * i + k] - (double)cloud->velocity[4 * j + k];
        speed2 += v * v;
        along += v * -d[k] / r;
    }
    return speed2 > 0 ? sqrt(speed2) * (1 - along / sqrt(speed2)) * (1 - r / h) *
                            (double)cloud->position[4 * j + 3] / room
                      : 0;
}

/* The harmonic mean speed, at the support radius, that the linear flow leaves over along the three axes. */
static double turbulence_by(double h, double squares[3][3], double sums[4][3], double gradient[4][3])
{
    double rest[3][3], inverse[3][3], determinant, size = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            rest[a][b] = h * h * squares[a][b];
            for (int c = 0; c < 3; c++)
                rest[a][b] -= h * h * gradient[a][c] * sums[b][c];
        }
    for (int k = 0; k < 3; k++)
        size += rest[k][k];
    for (int k = 0; k < 3; k++)
        rest[k][k] += 0.01 * size;
    invert(rest, inverse, &determinant);
    return size > 0 ? 1 / sqrt(inverse[0][0] + inverse[1][1] + inverse[2][2]) : 0;
}

static Reference reference(const Cloud *cloud, size_t i)
{
    const double h = cloud->state.support_radius, flat = cloud->space.flat;
    const double scale = flat ? 140 / M_PI / pow(h, 4) : 210 / M_PI / pow(h, 5);
    double moment[3][3] = {{0}}, own[3][3], sums[4][3] = {{0}}, gradient[4][3] = {{0}}, determinant;
    double squares[3][3] = {{0}};
    Reference out = {{0}, 0, {0}, 0, 0, 0};
    for (size_t j = 0; j < cloud->state.count; j++) {
        double d[3];
        const double r = apart(cloud, i, j, d);
        if (j == i || !(r < h))
            continue;
        out.neighbours++;
        out.trapped += trapped_by(cloud, i, j, d, r);
        const double w = scale * (double)cloud->position[4 * j + 3] * pow(1 - r / h, 3);
        double v[3];
        for (size_t a = 0; a < 3; a++)
            v[a] = (double)cloud->velocity[4 * j + a] - (double)cloud->velocity[4 * i + a];
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                moment[a][b] += w * d[a] * d[b];
                sums[a][b] += w * v[a] * d[b];
                squares[a][b] += w * v[a] * v[b];
            }
        for (int b = 0; b < 3; b++)
            sums[3][b] += w * ((double)cloud->pressure[j] - (double)cloud->pressure[i]) * d[b];
    }
    if (cloud->space.flat)
        moment[2][2] = 1;
    invert(moment, own, &determinant);
    double size = 0;
    for (int a = 0; a < 9; a++)
        size += own[a / 3][a % 3] * own[a / 3][a % 3];
    for (int k = 0; k < 3; k++)
        moment[k][k] += 0.1 * fmin(fmax(1 - 1 / (0.07 * sqrt(size)), 0), 1);
    invert(moment, own, &determinant);
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 3; b++)
            for (int c = 0; c < 3; c++)
                gradient[a][b] += sums[a][c] * own[c][b];
    out.turbulence = turbulence_by(h, squares, sums, gradient);
    for (int k = 0; k < 3; k++) {
        const int one = (k + 1) % 3, two = (k + 2) % 3;
        out.curl[k] = gradient[two][one] - gradient[one][two];
        out.divergence += gradient[k][k];
        out.slope[k] = gradient[3][k];
    }
    return out;
}

/* Returns the least neighbours of a particle. */
static double compare(const Cloud *cloud)
{
    double worst = 0, most = 0, few = INFINITY;
    for (size_t i = 0; i < cloud->state.count; i++) {
        const Reference r = reference(cloud, i);
        assert_true((double)cloud->scalar[SCALAR_NEIGHBOURS][i] == r.neighbours);
        const double size = sqrt(r.curl[0] * r.curl[0] + r.curl[1] * r.curl[1] + r.curl[2] * r.curl[2]);
        const double curl = cloud->space.flat ? r.curl[2] : size;
        most = fmax(most, size);
        few = fmin(few, r.neighbours);
        worst = fmax(worst, fabs((double)cloud->scalar[SCALAR_VORTICITY][i] - curl));
        worst = fmax(worst, fabs((double)cloud->scalar[SCALAR_DIVERGENCE][i] - r.divergence));
        worst = fmax(worst, fabs((double)cloud->scalar[SCALAR_TRAPPED_AIR][i] - r.trapped) / 0.03);
        for (int k = 0; k < 3; k++) {
            const size_t at = 4 * i + (size_t)k;
            worst = fmax(worst, fabs((double)cloud->vector[VECTOR_VORTICITY][at] - r.curl[k]));
            worst = fmax(worst, fabs((double)cloud->vector[VECTOR_PRESSURE_GRADIENT][at] - r.slope[k]) / 600);
            worst = fmax(worst, fabs((double)cloud->scalar[SCALAR_VORTICITY_X + k][i] - r.curl[k]));
            worst = fmax(worst,
                         fabs((double)cloud->scalar[SCALAR_PRESSURE_GRADIENT_X + k][i] - r.slope[k]) / 600);
        }
        const double steep =
            sqrt(r.slope[0] * r.slope[0] + r.slope[1] * r.slope[1] + r.slope[2] * r.slope[2]);
        worst = fmax(worst, fabs((double)cloud->scalar[SCALAR_PRESSURE_GRADIENT][i] - steep) / 600);
    }
    printf("worst %.3g of %.3g 1/s, %g neighbours at least\n", worst, most, few);
    assert_true(worst < 1e-5 * most);
    return few;
}

static void scattered_particles_are_as_summed_over_all(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        Cloud *cloud = scattered(dimensions == 2 ? 2000 : 4000, 0.03, dimensions == 2);
        derive(cloud);
        assert_true(compare(cloud) < 9); /* corners too */
        free(cloud);
    }
}

/* A box that is no whole number of cells wide. */
static void neighbours_across_periodic_sides_count(void **state)
{
    (void)state;
    for (int axes = 1; axes < 8; axes++) {
        Cloud *cloud = scattered(1000, 0.03, false);
        for (int k = 0; k < 3; k++)
            cloud->space.periodic[k] = axes >> k & 1;
        derive(cloud);
        compare(cloud);
        free(cloud);
    }
}

/* ---- foam ---- */

/* Turbulence of fast particles near air; no sums for slow particles. */
static void turbulence_of_fast_particles_alone(void **state)
{
    (void)state;
    int fast = 0;
    Cloud *cloud = scattered(600, 0.05, false);
    cloud->slowest = 1;
    derive(cloud);
    for (size_t i = 0; i < cloud->state.count; i++) {
        const float *v = cloud->velocity + 4 * i;
        const double turbulence = reference(cloud, i).turbulence, found = (double)cloud->foam[2 * i];
        const double most = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < 1 ? 0 : turbulence;
        fast += most > 0.05 && fabs(found - most) < 1e-4 * most;
        assert_true(found >= 0 && found <= 1.0001 * most + 1e-4);
    }
    printf("%d of %zu particles are fast and near air\n", fast, cloud->state.count);
    assert_in_range(fast, 10, cloud->state.count - 100);
    free(cloud);
}

/* A linear flow with velocities of chance; without chance along z for `plane`. */
static double turbulence_in_middle(bool plane)
{
    Cloud *cloud = lattice(8, 8, 8, 0.05, 2.1);
    unsigned seed = 7;
    double sum = 0;
    cloud->state.box_size[1] *= 2;
    set_linear(cloud, (double[3]){1, 2, 3}, 4);
    for (size_t i = 0; i < cloud->state.count; i++)
        for (size_t k = 0; k < 3; k++) {
            const float chance = (float)(2 * number(&seed) - 1);
            cloud->velocity[4 * i + k] += plane && k == 2 ? 0 : chance;
        }
    derive(cloud);
    for (size_t i = 0; i < cloud->state.count; i++)
        sum += (double)cloud->foam[2 * i];
    free(cloud);
    return sum / 64;
}

/* No turbulence in linear flows, little in fluid with roughness in a plane alone. */
static void turbulence_has_three_directions(void **state)
{
    (void)state;
    Cloud *cloud = lattice(8, 8, 8, 0.05, 2.1);
    cloud->state.box_size[1] *= 2;
    set_linear(cloud, (double[3]){1, 2, 3}, -4);
    derive(cloud);
    double most = 0;
    for (size_t i = 0; i < cloud->state.count; i++)
        most = fmax(most, (double)cloud->foam[2 * i]);
    free(cloud);
    const double plane = turbulence_in_middle(true), full = turbulence_in_middle(false);
    printf("turbulence of the top %.3g m/s in three directions, %.3g in a plane, %.3g in a linear flow\n",
           full, plane, most);
    assert_true(full > 0.3 && plane < 0.4 * full && most < 0.01 * full);
}

/* A tank half full of rough fluid: the top layer foams up to the walls, and layers below do not. */
static void turbulence_below_the_top_is_none(void **state)
{
    (void)state;
    Cloud *cloud = lattice(8, 8, 8, 0.05, 2.1);
    unsigned seed = 3;
    cloud->state.box_size[1] *= 2;
    for (size_t n = 0; n < 4 * cloud->state.count; n++)
        cloud->velocity[n] = (float)(2 * number(&seed) - 1);
    derive(cloud);
    for (size_t i = 0; i < cloud->state.count; i++) {
        const double found = (double)cloud->foam[2 * i], all = reference(cloud, i).turbulence;
        assert_true(i / 8 % 8 == 7 ? fabs(found - all) < 1e-4 * all : found == 0);
    }
    free(cloud);
}

static void what_needs_no_neighbours_is_of_each_particle(void **state)
{
    (void)state;
    Cloud *cloud = scattered(1000, 0.03, false);
    BoxState *box = &cloud->state.box;
    *box = (BoxState){
        .orientation = {0.5, -0.5, 0.5, 0.5}, .velocity = {1, 2, -3}, .angular_velocity = {2, 0.3, -1}};
    derive(cloud);
    for (size_t i = 0; i < cloud->state.count; i++) {
        const float *v = cloud->velocity + 4 * i, *x = cloud->position + 4 * i;
        const double at[3] = {x[0], x[1], x[2]};
        double arm[3], moved[3], in_box[3], energy = 0;
        for (int k = 0; k < 3; k++) {
            assert_true(cloud->scalar[SCALAR_VELOCITY_X + k][i] == v[k]);
            assert_true(cloud->vector[VECTOR_VELOCITY][4 * i + (size_t)k] == v[k]);
            energy += 0.5 * (double)cloud->density[i] * (double)(v[k] * v[k]);
        }
        assert_true(fabs((double)cloud->scalar[SCALAR_KINETIC_ENERGY][i] - energy) <= 1e-6 * energy);
        quat_rotate(box->orientation, at, arm);
        cross_product(box->angular_velocity, arm, moved);
        for (int k = 0; k < 3; k++)
            moved[k] += box->velocity[k];
        quat_rotate_inverse(box->orientation, moved, in_box);
        for (int k = 0; k < 3; k++)
            assert_true(fabs((double)cloud->vector[VECTOR_BOX_VELOCITY][4 * i + (size_t)k] - in_box[k]) <
                        1e-5);
    }
    free(cloud);
}

/* ---- non-finite numbers, and no particles ---- */

/* A non-finite velocity spoils only the particle's own value; a non-finite position has no neighbours. */
static void no_number_does_not_spread(void **state)
{
    (void)state;
    const double turn[3] = {0, 1, 0};
    Cloud *cloud = lattice(9, 9, 9, 0.05, 2.1);
    const size_t middle = 4 * 81 + 4 * 9 + 4, other = 81 + 9 + 1, count = cloud->state.count;
    set_linear(cloud, turn, 0);
    cloud->velocity[4 * middle] = NAN;
    cloud->position[4 * other + 1] = NAN;
    derive(cloud);
    assert_true(isnan(cloud->scalar[SCALAR_VORTICITY][middle]));
    assert_true(isnan(cloud->scalar[SCALAR_VELOCITY_X][middle]));
    assert_true(cloud->scalar[SCALAR_NEIGHBOURS][middle] == 32);
    assert_true(cloud->scalar[SCALAR_NEIGHBOURS][other] == 0);
    for (size_t i = 0; i < count; i++)
        if (i != middle && i != other)
            assert_true(fabs((double)cloud->scalar[SCALAR_VORTICITY][i] - 2) < 1e-4);
    free(cloud);
}

/* Spray and a sheet: a gradient that neighbours do not tell is bounded, and 0 for a particle alone. */
static void few_neighbours_blow_nothing_up(void **state)
{
    (void)state;
    Cloud *cloud = lattice(20, 1, 20, 0.05, 2.1);
    unsigned seed = 3;
    cloud->state.box_size[1] = 1;
    for (size_t i = 0; i < cloud->state.count; i++) {
        cloud->position[4 * i + 1] = (float)(0.5 + 1e-4 * number(&seed));
        for (int k = 0; k < 3; k++)
            cloud->velocity[4 * i + (size_t)k] = (float)(2 * number(&seed) - 1);
    }
    add(cloud, 0, 0.2, 0, 1e-4);
    derive(cloud);
    const size_t alone = cloud->state.count - 1;
    assert_true(cloud->scalar[SCALAR_VORTICITY][alone] == 0 && cloud->scalar[SCALAR_NEIGHBOURS][alone] == 0);
    for (size_t i = 0; i < alone; i++)
        assert_true(cloud->scalar[SCALAR_VORTICITY][i] < 2 / 0.05F); /* differences over a spacing */
    free(cloud);
}

static void no_particles_have_none(void **state)
{
    (void)state;
    Cloud *cloud = lattice(3, 3, 3, 0.05, 2.1);
    cloud->state.count = 0;
    derive(cloud);
    free(cloud);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_rigid_rotation_has_twice_its_rate, no_gl_errors),
        cmocka_unit_test_teardown(strain_and_eddies, no_gl_errors),
        cmocka_unit_test_teardown(an_expansion_has_no_vorticity, no_gl_errors),
        cmocka_unit_test_teardown(in_two_dimensions_the_vorticity_has_a_sign, no_gl_errors),
        cmocka_unit_test_teardown(a_linear_pressure_has_its_gradient, no_gl_errors),
        cmocka_unit_test_teardown(trapped_air_is_that_of_smooth_flows, no_gl_errors),
        cmocka_unit_test_teardown(turbulence_of_fast_particles_alone, no_gl_errors),
        cmocka_unit_test_teardown(turbulence_has_three_directions, no_gl_errors),
        cmocka_unit_test_teardown(old_foam_is_seen_on_the_surface, no_gl_errors),
        cmocka_unit_test_teardown(turbulence_below_the_top_is_none, no_gl_errors),
        cmocka_unit_test_teardown(two_that_meet_trap_air, no_gl_errors),
        cmocka_unit_test_teardown(scattered_particles_are_as_summed_over_all, no_gl_errors),
        cmocka_unit_test_teardown(neighbours_across_periodic_sides_count, no_gl_errors),
        cmocka_unit_test_teardown(what_needs_no_neighbours_is_of_each_particle, no_gl_errors),
        cmocka_unit_test_teardown(no_number_does_not_spread, no_gl_errors),
        cmocka_unit_test_teardown(few_neighbours_blow_nothing_up, no_gl_errors),
        cmocka_unit_test_teardown(no_particles_have_none, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
