#include "sim/solids/solid.h"

#include <math.h>
#include <string.h>

enum { OF_PAIR = 8, CONTACTS = 1024, ROUNDS = 12, PARTINGS = 4 };

typedef struct Contact {
    int body, other;     /* other: a solid, or BODY_AT_WALL */
    double x[3], n[3];   /* point; normal, towards the body */
    double gap;          /* m; less than 0: overlap */
    double wanted;       /* least speed along n, m/s */
    double push, rub[3]; /* impulses so far, N s */
} Contact;

typedef struct Contacts {
    int count;
    Contact of[CONTACTS];
} Contacts;

/* All points within reach between a body and another solid or wall. */
typedef struct Nearest {
    int count;
    Contact of[BODY_POINTS];
} Nearest;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_free(const BodyWorld *world, int solid)
{
    return solid != BODY_AT_WALL && world->solids[solid].density > 0;
}

static const BoxState *pose_of(const BodyWorld *world, const BodyStates *states, int solid)
{
    return is_free(world, solid) ? &states->of[solid].pose : &world->fixed[solid];
}

static void keep(Nearest *nearest, const Contact *contact)
{
    if (nearest->count < BODY_POINTS)
        nearest->of[nearest->count++] = *contact;
}

static double apart(const Contact *a, const Contact *b)
{
    double d[3];
    for (int k = 0; k < 3; k++)
        d[k] = a->x[k] - b->x[k];
    return sqrt(dot(d, d));
}

/* Adds up to OF_PAIR contacts: first the deepest, then in turn the point with the greatest distance from the
   taken points, less the height above the deepest. A flat body is thus held at all ends; with contacts on a
   single side the body would creep. */
static void add(Contacts *contacts, const Nearest *nearest)
{
    double merit[BODY_POINTS]; /* m */
    int best = 0;
    for (int i = 1; i < nearest->count; i++)
        best = nearest->of[i].gap < nearest->of[best].gap ? i : best;
    const Contact *deepest = &nearest->of[best];
    for (int i = 0; i < nearest->count; i++)
        merit[i] = INFINITY;
    for (int taken = 0; taken < OF_PAIR && taken < nearest->count && contacts->count < CONTACTS; taken++) {
        const Contact *last = &nearest->of[best];
        contacts->of[contacts->count++] = *last;
        merit[best] = -INFINITY;
        for (int i = 0; i < nearest->count; i++)
            merit[i] = fmin(merit[i], apart(&nearest->of[i], last) - (nearest->of[i].gap - deepest->gap));
        for (int i = 0; i < nearest->count; i++)
            best = merit[i] > merit[best] ? i : best;
    }
}

static void hull_point(const BodyWorld *world, const BoxState *pose, int body, int i, double x[3])
{
    quat_rotate(pose->orientation, world->bodies[body].hull.point[i], x);
    for (int k = 0; k < 3; k++)
        x[k] += pose->position[k];
}

/* Greatest distance the body can move in dt, m. */
static double way_of(const SolidDef *solid, const BoxState *pose, double dt)
{
    return dt * (sqrt(dot(pose->velocity, pose->velocity)) +
                 sqrt(dot(pose->angular_velocity, pose->angular_velocity)) * solid_reach(solid));
}

static void find_at_wall(const BodyWorld *world, const BodyStates *states, int body, double within, int axis,
                         int side, Contacts *contacts)
{
    const BodyHull *hull = &world->bodies[body].hull;
    const BoxState *pose = &states->of[body].pose;
    const double half = (double)world->walls->half_size[axis], low = axis == 1 ? 0 : -half,
                 at = side ? low + 2 * half : low, sign = side ? -1 : 1;
    const double reach = solid_reach(&world->solids[body]);
    Nearest nearest = {0};
    if (sign * (pose->position[axis] - at) > reach + within)
        return;
    for (int i = 0; i < hull->count; i++) {
        Contact contact = {.body = body, .other = BODY_AT_WALL};
        hull_point(world, pose, body, i, contact.x);
        contact.n[axis] = sign;
        contact.gap = sign * (contact.x[axis] - at) - hull->radius;
        contact.x[axis] -= sign * hull->radius;
        if (contact.gap < within)
            keep(&nearest, &contact);
    }
    add(contacts, &nearest);
}

static bool far_apart(const BodyWorld *world, const BodyStates *states, int a, int b, double within)
{
    const BoxState *one = pose_of(world, states, a), *two = pose_of(world, states, b);
    double d[3];
    for (int k = 0; k < 3; k++)
        d[k] = one->position[k] - two->position[k];
    const double most = solid_reach(&world->solids[a]) + solid_reach(&world->solids[b]) + within;
    return dot(d, d) > most * most;
}

/* Finds contacts of hull points of `solid` with the surface of `at`; at least one of both solids is free. */
static void find_at_solid(const BodyWorld *world, const BodyStates *states, int solid, int at, double within,
                          Contacts *contacts)
{
    const BodyHull *hull = &world->bodies[solid].hull;
    const BoxState *pose = pose_of(world, states, solid), *to = pose_of(world, states, at);
    const double reach = solid_reach(&world->solids[at]) + hull->radius + within;
    const bool own = is_free(world, solid);
    Nearest nearest = {0};
    for (int i = 0; i < hull->count; i++) {
        Contact contact = {.body = own ? solid : at, .other = own ? at : solid};
        double in[3];
        hull_point(world, pose, solid, i, contact.x);
        for (int k = 0; k < 3; k++)
            in[k] = contact.x[k] - to->position[k];
        if (dot(in, in) > reach * reach)
            continue;
        quat_rotate_inverse(to->orientation, in, in);
        contact.gap = solid_distance(&world->solids[at], world->dimensions, in) - hull->radius;
        if (!(contact.gap < within)) /* rejects NaN as well: the sentinel recovers from NaN */
            continue;
        solid_normal(&world->solids[at], world->dimensions, in, contact.n);
        quat_rotate(to->orientation, contact.n, contact.n);
        for (int k = 0; k < 3; k++) {
            contact.x[k] -= hull->radius * contact.n[k];
            contact.n[k] *= own ? 1 : -1;
        }
        keep(&nearest, &contact);
    }
    add(contacts, &nearest);
}

/* Finds all contacts within the distance both solids can move in dt. */
static void find(const BodyWorld *world, const BodyStates *states, double dt, Contacts *contacts)
{
    contacts->count = 0;
    for (int a = 0; a < world->count; a++) {
        if (!is_free(world, a))
            continue;
        const double own = way_of(&world->solids[a], pose_of(world, states, a), dt);
        for (int axis = 0; axis < world->dimensions; axis++)
            for (int side = 0; side < 2 && !world->walls->open[axis]; side++)
                find_at_wall(world, states, a, own, axis, side, contacts);
        for (int b = 0; b < world->count; b++) {
            const double within = own + way_of(&world->solids[b], pose_of(world, states, b), dt);
            if (b == a || far_apart(world, states, a, b, within))
                continue;
            find_at_solid(world, states, a, b, within, contacts);
            if (!is_free(world, b)) /* the loop reaches a free b as a */
                find_at_solid(world, states, b, a, within, contacts);
        }
    }
}

/* Velocity of the body relative to the other solid at the contact, m/s. */
static void approach(const BodyWorld *world, const BodyStates *states, const Contact *c, double v[3])
{
    double other[3] = {0};
    body_velocity(&states->of[c->body].pose, c->x, v);
    if (c->other != BODY_AT_WALL)
        body_velocity(pose_of(world, states, c->other), c->x, other);
    for (int k = 0; k < 3; k++)
        v[k] -= other[k];
}

static void hit(const BodyWorld *world, const Contact *c, const double blow[3], BodyStates *states)
{
    const double back[3] = {-blow[0], -blow[1], -blow[2]};
    body_hit(&world->bodies[c->body], c->x, blow, &states->of[c->body]);
    if (is_free(world, c->other))
        body_hit(&world->bodies[c->other], c->x, back, &states->of[c->other]);
}

static double yield_of(const BodyWorld *world, const BodyStates *states, const Contact *c, const double n[3])
{
    double yield = body_yield(&world->bodies[c->body], &states->of[c->body], c->x, n);
    if (is_free(world, c->other))
        yield += body_yield(&world->bodies[c->other], &states->of[c->other], c->x, n);
    return yield;
}

/* Relative to the yield of a free body. Below: the bodies are on hinges that the contact cannot turn, and
   impulses have no effect. */
static const double STIFF = 1e-12;

static void push_apart(const BodyWorld *world, Contact *c, BodyStates *states)
{
    const double yield = yield_of(world, states, c, c->n), before = c->push;
    double v[3], blow[3];
    approach(world, states, c, v);
    if (yield * world->bodies[c->body].mass.mass < STIFF)
        return;
    c->push = fmax(before + (c->wanted - dot(v, c->n)) / yield, 0);
    for (int k = 0; k < 3; k++)
        blow[k] = (c->push - before) * c->n[k];
    hit(world, c, blow, states);
}

static void rub(const BodyWorld *world, Contact *c, BodyStates *states)
{
    double v[3], t[3], all[3], blow[3];
    approach(world, states, c, v);
    const double along = dot(v, c->n);
    for (int k = 0; k < 3; k++)
        t[k] = v[k] - along * c->n[k];
    const double speed = sqrt(dot(t, t));
    for (int k = 0; k < 3 && speed > 0; k++)
        t[k] /= speed;
    const double yield = speed > 0 ? yield_of(world, states, c, t) : 0;
    if (yield * world->bodies[c->body].mass.mass < STIFF)
        return;
    for (int k = 0; k < 3; k++)
        all[k] = c->rub[k] - speed / yield * t[k];
    const double length = sqrt(dot(all, all)), most = BODY_FRICTION * c->push;
    for (int k = 0; k < 3; k++) {
        all[k] *= length > most ? most / length : 1;
        blow[k] = all[k] - c->rub[k];
        c->rub[k] = all[k];
    }
    hit(world, c, blow, states);
}

void body_contacts_hit(const BodyWorld *world, double dt, BodyStates *states)
{
    Contacts contacts;
    const double slow = sqrt(2 * world->gravity * world->spacing);
    find(world, states, dt, &contacts);
    for (int i = 0; i < contacts.count; i++) {
        Contact *c = &contacts.of[i];
        double v[3];
        approach(world, states, c, v);
        const double along = dot(v, c->n), gap = fmax(c->gap, 0);
        c->wanted = -gap / dt;
        if (along < -slow && along < c->wanted)
            c->wanted = -BODY_BOUNCE * along;
    }
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < contacts.count; i++) {
            push_apart(world, &contacts.of[i], states);
            rub(world, &contacts.of[i], states);
        }
}

bool body_overlap(const BodyWorld *world, const BodyStates *states, int body, double least,
                  BodyOverlap *overlap)
{
    Contacts contacts;
    unsigned sides = 0; /* two bits per axis */
    find(world, states, 0, &contacts);
    *overlap = (BodyOverlap){.depth = least, .fits = true};
    for (const Contact *c = contacts.of; c < contacts.of + contacts.count; c++) {
        if (c->body != body || c->gap > -least)
            continue;
        for (int k = 0; k < 3 && c->other == BODY_AT_WALL; k++)
            sides |= c->n[k] > 0 ? 1u << 2 * k : c->n[k] < 0 ? 2u << 2 * k : 0;
        if (-c->gap > overlap->depth)
            *overlap = (BodyOverlap){.other = c->other, .depth = -c->gap, .fits = true};
    }
    overlap->fits = !(sides & sides >> 1 & 0x15);
    return overlap->depth > least;
}

static void shift(const BodyWorld *world, int solid, const double n[3], double by, BodyStates *states)
{
    if (is_free(world, solid) && !world->bodies[solid].hinged)
        for (int k = 0; k < 3; k++)
            states->of[solid].pose.position[k] += by * n[k];
}

static double share_of(const BodyWorld *world, int solid)
{
    return is_free(world, solid) && !world->bodies[solid].hinged ? 1 / world->bodies[solid].mass.mass : 0;
}

/* Parts the deepest point of each pair, up to PARTINGS times: parting a pair may press the next pair. */
double body_contacts_part(const BodyWorld *world, BodyStates *states)
{
    double furthest = 0;
    Contacts contacts;
    for (int time = 0; time < PARTINGS; time++) {
        bool any = false;
        find(world, states, 0, &contacts);
        for (int i = 0, end; i < contacts.count; i = end) {
            const Contact *c = &contacts.of[i];
            const int body = c->body, other = c->other;
            const double *n = c->n;
            for (end = i + 1; end < contacts.count && contacts.of[end].body == body &&
                              contacts.of[end].other == other && dot(contacts.of[end].n, n) > 0.5;
                 end++)
                c = contacts.of[end].gap < c->gap ? &contacts.of[end] : c;
            const double own = share_of(world, body), its = share_of(world, other);
            if (c->gap >= 0 || own + its == 0)
                continue;
            any = true;
            furthest = fmax(furthest, -c->gap);
            shift(world, body, c->n, -c->gap * own / (own + its), states);
            shift(world, other, c->n, c->gap * its / (own + its), states);
        }
        if (!any)
            break;
    }
    return furthest;
}
