// pbf: number density and what it makes of a particle's k: pbf_sums in sim/pbf/pairs.c, pbf_images_sums in
// sim/pbf/pairs_images.c. The shader declares position[] and name[].

// Of W; F x_ij and of an image; F^2 r^2 / m_j.
float heights = 1.0, squares = 0.0;
vec3 slope = vec3(0), image_slope;

vec3 weigh(vec3 d, float q, float inverse_mass)
{
    vec3 force = gradient * shape(q) * d;
    heights += height(q);
    squares += dot(force, force) * inverse_mass;
    return force;
}

void meet(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support || j == self)
        return;
    SEPARATE(name[self].x, name[j].x, d)
    slope += weigh(d, q_of(d), 1.0 / fluids[FLUID_OF(j)].mass);
}

// The particle's own image has its k, too.
void meet_image(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    float inverse_mass = j == self ? 0.0 : 1.0 / fluids[FLUID_OF(j)].mass, times = j == self ? 2.0 : 1.0;
    image_slope += times * weigh(d, image_q(d), inverse_mass);
}

#ifdef SOLIDS
void meet_boundary(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    SEPARATE(name[self].x, BOUNDARY_ID + boundary_state[j].y, d)
    slope += weigh(d, q_of(d), 0.0);
}

void meet_boundary_image(uint j, vec3 d, float volume)
{
    if (dot(d, d) < support * support)
        image_slope += weigh(d, image_q(d), 0.0);
}
#endif

void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_slope = vec3(0);
        WALK_NEIGHBOURS(self, image.x, at, meet_image, meet_boundary_image, 0)
        slope += image.sign * image_slope;
    }
}

void sum_up(uint i, vec3 x)
{
    ivec3 at = cell_of(x);
    self = i;
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    walk_images(x, at);
}
