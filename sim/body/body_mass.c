#include "sim/body/body_mass.h"

#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <string.h>

static void moments_of_ball(Moments *m, double r, bool flat)
{
    m->volume = flat ? M_PI * r * r : 4 * M_PI / 3 * pow(r, 3);
    for (int k = 0; k < 3; k++)
        m->second[k][k] = m->volume * r * r / (flat ? 4 : 5);
}

static void moments_of_box(Moments *m, const double size[3], bool flat)
{
    m->volume = size[0] * size[1] * (flat ? 1 : size[2]);
    for (int k = 0; k < 3; k++)
        m->second[k][k] = m->volume * size[k] * size[k] / 12;
}

static void moments_of_cylinder(Moments *m, double r, double height)
{
    m->volume = M_PI * r * r * height;
    m->second[0][0] = m->second[2][2] = m->volume * r * r / 4;
    m->second[1][1] = m->volume * height * height / 12;
}

/* Adds `sign` times the half y < 0 of a ball or disc. */
static void add_half_ball(Moments *m, double r, bool flat, double sign)
{
    Moments whole = {0};
    moments_of_ball(&whole, r, flat);
    m->volume += sign * 0.5 * whole.volume;
    m->first[1] -= sign * (flat ? 2 * pow(r, 3) / 3 : M_PI * pow(r, 4) / 4);
    for (int k = 0; k < 3; k++)
        m->second[k][k] += sign * 0.5 * whole.second[k][k];
}

/* Adds the tetrahedron of the origin and a triangle: positive volume if the normal points away from the
   origin. */
static void add_tetrahedron(Moments *m, const double a[3], const double b[3], const double c[3])
{
    double across[3];
    cross_product(b, c, across);
    const double six = a[0] * across[0] + a[1] * across[1] + a[2] * across[2];
    m->volume += six / 6;
    for (int i = 0; i < 3; i++) {
        m->first[i] += six / 24 * (a[i] + b[i] + c[i]);
        for (int j = 0; j < 3; j++)
            m->second[i][j] +=
                six / 120 *
                ((a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]) + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
    }
}

/* Volumes within several parts of a mesh count once. */
static void take_excess(Moments *m, const Moments *excess, double scale)
{
    m->volume -= pow(scale, 3) * excess->volume;
    for (int i = 0; i < 3; i++) {
        m->first[i] -= pow(scale, 4) * excess->first[i];
        for (int j = 0; j < 3; j++)
            m->second[i][j] -= pow(scale, 5) * excess->second[i][j];
    }
}

static void moments_of_mesh(Moments *m, const MeshUse *mesh)
{
    const Triangles *all = &mesh->shape->triangles;
    for (size_t t = 0; t < all->triangle_count; t++) {
        double corner[3][3];
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                corner[v][k] = mesh->scale * (double)all->vertex[all->triangle[t][v]][k];
        add_tetrahedron(m, corner[0], corner[1], corner[2]);
    }
    take_excess(m, &mesh->shape->excess, mesh->scale);
}

static void moments_of(const SolidDef *solid, bool flat, Moments *m)
{
    memset(m, 0, sizeof *m);
    switch (solid->kind) {
    case SOLID_BOX:
        moments_of_box(m, solid->size, flat);
        break;
    case SOLID_CYLINDER:
        moments_of_cylinder(m, solid->radius, solid->height);
        break;
    case SOLID_BOWL:
        add_half_ball(m, solid->radius + solid->thickness, flat, 1);
        add_half_ball(m, solid->radius, flat, -1);
        break;
    case SOLID_MESH:
        moments_of_mesh(m, &solid->mesh);
        break;
    default:
        moments_of_ball(m, solid->radius, flat);
    }
}

/* Turns the matrix in the plane of axes p and q so that a[p][q] becomes 0, and turns `axes` along. */
static void turn_away(double a[3][3], int p, int q, double axes[4])
{
    if (a[p][q] == 0)
        return;
    const double angle = 0.5 * atan2(2 * a[p][q], a[q][q] - a[p][p]), c = cos(angle), s = sin(angle);
    for (int k = 0; k < 3; k++) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; k++) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
    }
    /* The new axes: p' = c p - s q, q' = s p + c q, a turn about the third axis. */
    double turn[4] = {0, 0, 0, cos(0.5 * angle)};
    turn[3 - p - q] = (q == (p + 1) % 3 ? -1 : 1) * sin(0.5 * angle);
    quat_multiply(axes, turn, axes);
}

/* Jacobi rotations: a few sweeps make the matrix diagonal to the last digit. */
static void to_principal(double a[3][3], double axes[4])
{
    axes[0] = axes[1] = axes[2] = 0, axes[3] = 1;
    for (int sweep = 0; sweep < 12; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++)
                turn_away(a, p, q, axes);
}

/* A disc of radius a, moving along the axis, carries 8 a^3 / 3 of fluid along (Lamb, "Hydrodynamics", article
   102). In two dimensions a plate of width 2 a carries pi a^2. `broad` is half of the carried volume. The
   disc has the area of the greatest face of the block with the body's inertia. */
static void extents(const double second[3][3], bool flat, BodyMass *mass)
{
    double length[3], most = 0;
    mass->area = 0;
    for (int k = 0; k < 3; k++)
        length[k] = sqrt(12 * second[k][k] / mass->volume);
    for (int k = 0; k < 3; k++) {
        const double face = length[k] * length[(k + 1) % 3];
        most = fmax(most, face);
        mass->area += 2 * face;
    }
    mass->broad = 4.0 / 3 * pow(most / M_PI, 1.5);
    if (flat) {
        mass->area = 2 * (length[0] + length[1]);
        mass->broad = M_PI / 8 * pow(fmax(length[0], length[1]), 2);
    }
}

void body_mass(const SolidDef *solid, int dimensions, BodyMass *mass)
{
    const bool flat = dimensions == 2;
    Moments m;
    moments_of(solid, flat, &m);
    mass->volume = m.volume;
    mass->mass = solid->density * m.volume;
    for (int i = 0; i < 3; i++)
        mass->centre[i] = m.first[i] / m.volume;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m.second[i][j] -= m.volume * mass->centre[i] * mass->centre[j];
    if (flat) {
        extents((const double(*)[3])m.second, flat, mass);
        mass->axes[0] = mass->axes[1] = mass->axes[2] = 0, mass->axes[3] = 1;
        for (int k = 0; k < 3; k++)
            mass->inertia[k] = solid->density * (m.second[0][0] + m.second[1][1]);
        return;
    }
    to_principal(m.second, mass->axes);
    extents((const double(*)[3])m.second, flat, mass);
    for (int k = 0; k < 3; k++)
        mass->inertia[k] =
            solid->density * (m.second[(k + 1) % 3][(k + 1) % 3] + m.second[(k + 2) % 3][(k + 2) % 3]);
}
