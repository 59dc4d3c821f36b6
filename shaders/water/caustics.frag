// Spreads a point's light over nearby texels by a cubic B-spline. The shares add up to 1 for any position of the point, so the
// total light is kept; points a texel apart give even light.
layout(location = 0) flat in vec2 centre;
layout(location = 0) out float light;

vec2 spline(vec2 at)
{
    vec2 away = abs(at), near = 2.0 / 3.0 - away * away * (1.0 - 0.5 * away), far = max(2.0 - away, 0.0);
    return mix(near, far * far * far / 6.0, greaterThan(away, vec2(1.0)));
}

void main()
{
    vec2 shares = spline(gl_FragCoord.xy - centre);
    light = shares.x * shares.y;
}
