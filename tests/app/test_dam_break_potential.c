/* The collapse of a column without viscosity by boundary elements, as in scenes/reference/dam-break-
   potential.csv. After: M. S. Longuet-Higgins, E. D. Cokelet, "The deformation of steep surface waves on
   water. I. A numerical method of computation", 1976. The surface's points move with the fluid, D phi / D
   t = v^2 / 2 - g y on the surface. Laplace's equation gives the velocity across the surface from phi.
   The walls x = 0 and y = 0 are mirrors, so only the surface has elements. Lengths over the column's
   width a, times over sqrt(a / g). SLOSH_POTENTIAL=FILE rewrites the file with more elements.
   SLOSH_POTENTIAL_WALL=FILE writes the pressures of dam-break-pressure.csv: the run continues after the
   fluid meets an end wall, then a mirror too. */
#include "tests/sim/fixture.h"

#include "app/bench/cases/case.h"

#include <complex.h>

enum { MOST = 128, FINER_AT_WALL = 6 };
static const double PI = 3.14159265358979;

/* From the top at the wall x = 0 to the toe on the floor y = 0, or to the end wall once the fluid is there;
   the fluid is on the right. */
typedef struct Surface {
    int elements; /* points: an extra */
    double wall;  /* x of the end wall, which is a mirror too, once the fluid is there; 0: not yet */
    double x[MOST + 1], y[MOST + 1], phi[MOST + 1];
} Surface;

/* Integrals over the element from a to b of ln r and of its derivative along the left normal, seen from p. */
static void integrals(const double p[2], const double a[2], const double b[2], double *single, double *normal)
{
    const double length = hypot(b[0] - a[0], b[1] - a[1]),
                 t[2] = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
    const double from = (a[0] - p[0]) * t[0] + (a[1] - p[1]) * t[1], to = from + length;
    const double h = (a[1] - p[1]) * t[0] - (a[0] - p[0]) * t[1];
    *normal = fabs(h) > 1e-14 ? atan2(h * length, h * h + from * to) : 0;
    *single = 0.5 * (to * log(to * to + h * h) - from * log(from * from + h * h)) - length + h * *normal;
}

/* With the mirrors x = 0 and x = wall the fluid repeats every 2 walls. The sum of ln r over all images is
   the sum of the middle image and two neighbours, plus ln |sin w / (w (1 - w^2 / pi^2))|, w = pi z / (2
   wall). */
static double complex rest_of_images(double complex z, double wall)
{
    const double complex w = PI / (2 * wall) * z;
    return cabs(w) < 1e-6 ? 1 : csin(w) / (w * (1 - w * w / (PI * PI)));
}

static void add_images(const double p[2], const double a[2], const double b[2], double wall, double *single,
                       double *normal)
{
    const double complex from = a[0] - p[0] + I * (a[1] - p[1]), to = b[0] - p[0] + I * (b[1] - p[1]);
    for (int side = -1; side <= 1; side += 2) {
        double s, n;
        integrals((double[2]){p[0] + 2 * side * wall, p[1]}, a, b, &s, &n);
        *single += s;
        *normal += n;
    }
    const double complex r0 = rest_of_images(from, wall), r1 = rest_of_images(to, wall),
                         middle = rest_of_images(0.5 * (from + to), wall);
    *single += cabs(to - from) * (log(cabs(r0)) + 4 * log(cabs(middle)) + log(cabs(r1))) / 6;
    *normal -= carg(r1 / r0);
}

/* Of element j, seen from x, y and its mirror images. */
static void seen(const Surface *s, int j, double x, double y, double *single, double *normal)
{
    const double a[2] = {s->x[j], s->y[j]}, b[2] = {s->x[j + 1], s->y[j + 1]};
    *single = *normal = 0;
    for (int mirror = 0; mirror < 4; mirror++) {
        const double p[2] = {mirror & 1 ? -x : x, mirror & 2 ? -y : y};
        double one, other;
        integrals(p, a, b, &one, &other);
        if (s->wall > 0)
            add_images(p, a, b, s->wall, &one, &other);
        *single += one;
        *normal += other;
    }
}

static void solve(int n, double a[MOST][MOST], double b[MOST], double out[MOST])
{
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k]))
                pivot = i;
        for (int j = 0; j < n; j++) {
            const double swap = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = swap;
        }
        const double swap = b[k];
        b[k] = b[pivot];
        b[pivot] = swap;
        for (int i = k + 1; i < n; i++) {
            const double factor = a[i][k] / a[k][k];
            for (int j = k; j < n; j++)
                a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        out[i] = b[i];
        for (int j = i + 1; j < n; j++)
            out[i] -= a[i][j] * out[j];
        out[i] /= a[i][i];
    }
}

/* The velocity across each element, outwards: Green's third identity at its middle. */
static void fluxes(const Surface *s, double q[MOST])
{
    static double a[MOST][MOST], b[MOST];
    for (int i = 0; i < s->elements; i++) {
        b[i] = -0.5 * PI * (s->phi[i] + s->phi[i + 1]);
        for (int j = 0; j < s->elements; j++) {
            double normal;
            seen(s, j, 0.5 * (s->x[i] + s->x[i + 1]), 0.5 * (s->y[i] + s->y[i + 1]), &a[i][j], &normal);
            b[i] += 0.5 * normal * (s->phi[j] + s->phi[j + 1]);
        }
    }
    solve(s->elements, a, b, q);
}

/* Rates of a surface's points, as a surface. */
static Surface rates(const Surface *s)
{
    double q[MOST], u[MOST] = {0}, v[MOST] = {0}, length[MOST] = {0};
    const int n = s->elements;
    Surface rate = {.elements = n, .wall = s->wall};
    fluxes(s, q);
    for (int i = 0; i < n; i++) {
        length[i] = hypot(s->x[i + 1] - s->x[i], s->y[i + 1] - s->y[i]);
        const double t[2] = {(s->x[i + 1] - s->x[i]) / length[i], (s->y[i + 1] - s->y[i]) / length[i]};
        const double along = (s->phi[i + 1] - s->phi[i]) / length[i];
        u[i] = along * t[0] - q[i] * t[1];
        v[i] = along * t[1] + q[i] * t[0];
    }
    for (int i = 0; i <= n; i++) { /* linear between the middles of elements, beyond the last ones too */
        const int a = i == 0 ? 0 : i == n ? n - 2 : i - 1, b = a + 1;
        const double at = i == 0 ? -length[0] : i == n ? length[a] + 2 * length[b] : length[a];
        const double share = at / (length[a] + length[b]);
        rate.x[i] = i > 0 && !(i == n && s->wall > 0) ? u[a] + (u[b] - u[a]) * share : 0;
        rate.y[i] = i < n || s->wall > 0 ? v[a] + (v[b] - v[a]) * share : 0;
        rate.phi[i] = 0.5 * (rate.x[i] * rate.x[i] + rate.y[i] * rate.y[i]) - s->y[i];
    }
    return rate;
}

static Surface moved(const Surface *s, const Surface *rate, double dt)
{
    Surface out = *s;
    for (int i = 0; i <= s->elements; i++) {
        out.x[i] += dt * rate->x[i];
        out.y[i] += dt * rate->y[i];
        out.phi[i] += dt * rate->phi[i];
    }
    return out;
}

/* So many elements anew along the surface, `finer` times shorter at the toe, by cubics through four points.
 */
static Surface spread(const Surface *s, int elements, double finer)
{
    const int n = s->elements;
    double at[MOST + 1] = {0};
    Surface out = {
        .elements = elements, .wall = s->wall, .x[0] = s->x[0], .y[0] = s->y[0], .phi[0] = s->phi[0]};
    out.x[elements] = s->x[n];
    out.y[elements] = s->y[n];
    out.phi[elements] = s->phi[n];
    for (int i = 0; i < n; i++)
        at[i + 1] = at[i] + hypot(s->x[i + 1] - s->x[i], s->y[i + 1] - s->y[i]);
    for (int i = 1, k = 0; i < elements; i++) {
        const double place = at[n] * (1 - pow(finer, -(double)i / elements)) / (1 - 1 / finer);
        while (k < n - 1 && at[k + 1] < place)
            k++;
        const int first = k < 1 ? 0 : k > n - 2 ? n - 3 : k - 1;
        out.x[i] = out.y[i] = out.phi[i] = 0;
        for (int a = first; a < first + 4; a++) {
            double weight = 1;
            for (int b = first; b < first + 4; b++)
                weight *= b == a ? 1 : (place - at[b]) / (at[a] - at[b]);
            out.x[i] += weight * s->x[a];
            out.y[i] += weight * s->y[a];
            out.phi[i] += weight * s->phi[a];
        }
    }
    return out;
}

/* Takes out what alternates from point to point and leaves cubics; Longuet-Higgins and Cokelet, eq. 3.8. */
static void smooth(double *f, int n)
{
    double before[MOST + 1];
    memcpy(before, f, sizeof(double) * (size_t)(n + 1));
    for (int i = 2; i <= n - 2; i++)
        f[i] = (-before[i - 2] + 4 * before[i - 1] + 10 * before[i] + 4 * before[i + 1] - before[i + 2]) / 16;
}

static Surface stepped(const Surface *s, double dt, double finer, bool smoothed)
{
    const Surface r1 = rates(s), s2 = moved(s, &r1, dt / 2), r2 = rates(&s2), s3 = moved(s, &r2, dt / 2),
                  r3 = rates(&s3), s4 = moved(s, &r3, dt), r4 = rates(&s4);
    Surface out = moved(s, &r1, dt / 6);
    out = moved(&out, &r2, dt / 3);
    out = moved(&out, &r3, dt / 3);
    out = moved(&out, &r4, dt / 6);
    out = spread(&out, out.elements, finer);
    if (smoothed) {
        smooth(out.x, out.elements);
        smooth(out.y, out.elements);
        smooth(out.phi, out.elements);
    }
    return out;
}

/* At rest, twice as high as wide. */
static Surface column(int elements)
{
    Surface s = {.elements = elements};
    const int top = elements / 3;
    for (int i = 0; i <= elements; i++) {
        s.x[i] = i < top ? (double)i / top : 1;
        s.y[i] = i < top ? 2 : 2 - 2.0 * (i - top) / (elements - top);
    }
    return s;
}

static double area(const Surface *s)
{
    double sum = 0;
    for (int i = 0; i < s->elements; i++)
        sum += 0.5 * (s->y[i] + s->y[i + 1]) * (s->x[i + 1] - s->x[i]);
    return sum;
}

/* Kinetic and potential energy, over rho g a^3. */
static double energy(const Surface *s)
{
    double q[MOST], sum = 0;
    fluxes(s, q);
    for (int i = 0; i < s->elements; i++) {
        const double dx = s->x[i + 1] - s->x[i], y = s->y[i], dy = s->y[i + 1] - y;
        sum += 0.25 * (s->phi[i] + s->phi[i + 1]) * q[i] * hypot(dx, dy);
        sum += 0.5 * dx * (y * y + y * dy + dy * dy / 3);
    }
    return sum;
}

/* How high the fluid is at x, over the floor; 0: it is not there yet. */
static double height_at(const Surface *s, double x)
{
    int k = s->elements;
    while (k > 0 && s->x[k] > x)
        k--;
    return k == s->elements ? 0 : s->y[k] + (x - s->x[k]) / (s->x[k + 1] - s->x[k]) * (s->y[k + 1] - s->y[k]);
}

/* The tip that is beyond the end wall is cut off there. */
static void land(Surface *s, double wall)
{
    const double y = height_at(s, wall);
    const int elements = s->elements;
    while (s->x[s->elements - 1] > wall)
        s->elements--;
    const int n = s->elements;
    s->phi[n] = s->phi[n - 1] + (s->phi[n] - s->phi[n - 1]) * (wall - s->x[n - 1]) / (s->x[n] - s->x[n - 1]);
    s->x[n] = s->wall = wall;
    s->y[n] = y;
    *s = spread(s, elements, FINER_AT_WALL);
}

/* A layer along the end wall thinner than this is cut off: without pressure. */
static void cut_jet(Surface *s, double thinnest)
{
    const int elements = s->elements;
    int k = elements / 2;
    while (k < elements - 1 && !(s->x[k] > s->wall - thinnest && s->y[k] < s->y[k + 1]))
        k++;
    if (k == elements - 1)
        return;
    s->elements = k + 1;
    s->x[k + 1] = s->wall;
    s->y[k + 1] = s->y[k];
    s->phi[k + 1] = s->phi[k];
    *s = spread(s, elements, FINER_AT_WALL);
}

/* phi at a place in the fluid, by what is on the surface: Green's third identity. */
static double potential_at(const Surface *s, const double q[MOST], double x, double y)
{
    double sum = 0;
    for (int j = 0; j < s->elements; j++) {
        double single, normal;
        seen(s, j, x, y, &single, &normal);
        sum += 0.5 * normal * (s->phi[j] + s->phi[j + 1]) - single * q[j];
    }
    return sum / (2 * PI);
}

enum { PLACES = 5 };

static const double STRIP = 0.2; /* of the walls, from the floor up */

/* Mean pressure over rho g a on the lowest part of the wall at x, by Bernoulli. d phi / d t is a separate
   potential, -v^2 / 2 - g y on the surface. */
static double pressure_at(const Surface *s, double x)
{
    const Surface rate = rates(s);
    Surface change = *s;
    double q[MOST], r[MOST], sum = 0;
    for (int i = 0; i <= s->elements; i++)
        change.phi[i] = -0.5 * (rate.x[i] * rate.x[i] + rate.y[i] * rate.y[i]) - s->y[i];
    fluxes(s, q);
    fluxes(&change, r);
    for (int k = 0; k < PLACES; k++) {
        const double y = (k + 0.5) * STRIP / PLACES, d = 0.01;
        const double v = (potential_at(s, q, x, y + d) - potential_at(s, q, x, y - d)) / (2 * d);
        sum -= potential_at(&change, r, x, y) + 0.5 * v * v + y;
    }
    return sum / PLACES;
}

enum { ROWS = 17 };

/* The front's Z and the height H at the wall at T = 0.2, 0.4, ... 3.4, and at the last of them the surface.
 */
static Surface fall(int elements, double dt, double z[ROWS], double h[ROWS])
{
    Surface s = column(elements);
    double last = 0, before = 1, above = 2;
    int row = 0;
    for (int i = 1; row < ROWS; i++) {
        s = stepped(&s, dt, 3, i % 2 == 0);
        const double time = sqrt(2) * dt * i, front = s.x[elements], top = s.y[0];
        for (; row < ROWS && 0.2 * (row + 1) <= time + 1e-9; row++) {
            const double part = (0.2 * (row + 1) - last) / (time - last);
            z[row] = before + (front - before) * part;
            h[row] = above + (top - above) * part;
        }
        last = time;
        before = front;
        above = top;
    }
    return s;
}

/* Pressure at T = 0.2, 0.4, ... 3.4 behind the column, and at 3.8, 3.85, ... 4.2 on a wall five widths
   away. The tip lower than `thinnest` is cut off, and the rising jet too. */
enum { LANDED = 9 };
static const double FIRST_LANDED = 3.8, EVERY_LANDED = 0.05;

static Surface fall_on(int elements, double dt, double thinnest, double behind[ROWS], double on[LANDED])
{
    const double wall = 5;
    Surface s = column(elements);
    double time = 0;
    int row = 0, steps = 0;
    while (height_at(&s, wall) < 1.5 * thinnest) {
        s = stepped(&s, dt, 3, ++steps % 2 == 0);
        time += sqrt(2) * dt;
        if (row < ROWS && time >= 0.2 * (row + 1))
            behind[row++] = pressure_at(&s, 0);
    }
    land(&s, wall);
    for (row = 0; row < LANDED; row++)
        while (time < FIRST_LANDED + EVERY_LANDED * row) {
            s = stepped(&s, 0.1 * dt, FINER_AT_WALL, ++steps % 3 == 0);
            cut_jet(&s, thinnest);
            time += sqrt(2) * 0.1 * dt;
            if (time >= FIRST_LANDED + EVERY_LANDED * row)
                on[row] = pressure_at(&s, wall);
        }
    return s;
}

/* phi = x^2 - y^2 has no velocity across the mirrors. */
static void fluxes_are_those_of_a_known_flow(void **state)
{
    (void)state;
    Surface s = {.elements = MOST};
    double q[MOST];
    for (int i = 0; i <= MOST; i++) {
        const double angle = 0.5 * PI * (1 - (double)i / MOST);
        s.x[i] = 1.5 * cos(angle);
        s.y[i] = sin(angle);
        s.phi[i] = s.x[i] * s.x[i] - s.y[i] * s.y[i];
    }
    fluxes(&s, q);
    for (int i = 0; i < MOST; i++) {
        const double dx = s.x[i + 1] - s.x[i], dy = s.y[i + 1] - s.y[i], length = hypot(dx, dy);
        const double exact = (-(s.x[i] + s.x[i + 1]) * dy - (s.y[i] + s.y[i + 1]) * dx) / length;
        if (fabs(q[i] - exact) > 0.01)
            fail_msg("across element %d: %g, not %g", i, q[i], exact);
    }
}

static void the_file_is_this_flow(void **state)
{
    (void)state;
    static Reference file;
    Error error = {{0}};
    double z[ROWS], h[ROWS];
    const Surface begin = column(60), end = fall(60, 0.02, z, h);
    assert_true(fabs(area(&end) / area(&begin) - 1) < 0.003);
    assert_true(fabs(energy(&end) / energy(&begin) - 1) < 0.01);
    assert_true(reference_load("scenes/reference/dam-break-potential.csv", &file, &error));
    assert_int_equal(file.rows, ROWS);
    for (int row = 0; row < ROWS; row++) {
        assert_true(fabs(reference_number(&file, row, "T") - 0.2 * (row + 1)) < 1e-9);
        if (fabs(reference_number(&file, row, "Z") / z[row] - 1) > 0.025)
            fail_msg("at T = %g: %g, not %g", 0.2 * (row + 1), reference_number(&file, row, "Z"), z[row]);
        if (fabs(reference_number(&file, row, "H") / h[row] - 1) > 0.01)
            fail_msg("at T = %g: H %g, not %g", 0.2 * (row + 1), reference_number(&file, row, "H"), h[row]);
    }
}

static void the_file_of_pressure_is_this_flow(void **state)
{
    (void)state;
    static Reference file;
    Error error = {{0}};
    double behind[ROWS], on[LANDED];
    const Surface begin = column(60), end = fall_on(60, 0.02, 0.06, behind, on);
    assert_true(fabs(area(&end) / area(&begin) - 1) < 0.025); /* the part cut off */
    assert_true(reference_load("scenes/reference/dam-break-pressure.csv", &file, &error));
    assert_int_equal(file.rows, ROWS + LANDED);
    for (int row = 0; row < ROWS + LANDED; row++) {
        const bool first = row < ROWS;
        const double is = reference_number(&file, row, first ? "behind" : "end"),
                     found = first ? behind[row] : on[row - ROWS];
        if (first ? fabs(is - found) > 0.03 : row > ROWS + 1 && fabs(is - found) > 0.1) /* 0.02, 0.08 */
            fail_msg("at T = %g: %g, not %g", reference_number(&file, row, "T"), is, found);
    }
}

static void write_pressure(const char *path)
{
    double behind[ROWS], on[LANDED];
    FILE *file = fopen(path, "w");
    const Surface end = fall_on(120, 0.01, 0.03, behind, on);
    fprintf(stderr, "with the wall: area %g at the end\n", area(&end));
    fputs(
        "# slosh, tests/app/test_dam_break_potential.c: SLOSH_POTENTIAL_WALL=FILE build/release/tests/test_app dam_break_potential\n"
        "# The column of dam-break-potential.csv in a tank of five widths: pressure over rho g a, the mean over the lowest 0.2 a "
        "of the wall behind the column and of the wall that it meets at T = 3.5; potential flow by 120 boundary elements, whose "
        "jet along that wall is cut off where it is thinner than 0.03 a; "
        "within 2 % from T = 3.85 on, 5 % before. T = t sqrt(2 g / a).\nT,behind,end\n",
        file);
    for (int row = 0; row < ROWS; row++)
        fprintf(file, "%.2f,%.3f,\n", 0.2 * (row + 1), behind[row]);
    for (int row = 0; row < LANDED; row++)
        fprintf(file, "%.2f,,%.3f\n", FIRST_LANDED + EVERY_LANDED * row, on[row]);
    fclose(file);
}

static void write_file(const char *path)
{
    double z[ROWS], h[ROWS];
    FILE *file = fopen(path, "w");
    const Surface end = fall(120, 0.01, z, h);
    fprintf(stderr, "area %g, energy %g at the end\n", area(&end), energy(&end));
    fputs(
        "# slosh, tests/app/test_dam_break_potential.c: SLOSH_POTENTIAL=FILE build/release/tests/test_app dam_break_potential\n"
        "# The column of Martin and Moyce 1952 (n^2 = 2) without viscosity and walls' friction, let go at once: potential "
        "flow by 120 boundary elements, within 1 %. T = t sqrt(2 g / a), Z = x / a of the front, H = y / a at the wall.\nT,Z,H\n",
        file);
    for (int row = 0; row < ROWS; row++)
        fprintf(file, "%.1f,%.3f,%.3f\n", 0.2 * (row + 1), z[row], h[row]);
    fclose(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fluxes_are_those_of_a_known_flow),
        cmocka_unit_test(the_file_is_this_flow),
        cmocka_unit_test(the_file_of_pressure_is_this_flow),
    };
    if (getenv("SLOSH_POTENTIAL"))
        write_file(getenv("SLOSH_POTENTIAL"));
    if (getenv("SLOSH_POTENTIAL_WALL"))
        write_pressure(getenv("SLOSH_POTENTIAL_WALL"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
