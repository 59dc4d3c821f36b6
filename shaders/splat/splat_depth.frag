// Pass 1, visibility: the nearest sphere's depth, by minimum blending. After: Adams et al. 2006, section 3.1; readers of the map
// add the shift by eps.
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"

layout(location = 0) out float nearest;

void main()
{
    Splat hit = splat_here();
    nearest = splat_seen(hit) ? hit.depth : 1e30;
}
