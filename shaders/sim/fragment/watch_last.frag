// Combines the steps since the last reading: texel 0 has the maxima, texel 1 the number of times the guard held.
uniform usampler2D finer, held, before;
layout(location = 0) out uvec4 watch;

void main()
{
    if (gl_FragCoord.x < 1.0)
        watch = max(texelFetch(finer, ivec2(0), 0), texelFetch(before, ivec2(0), 0));
    else
        watch = uvec4(texelFetch(held, ivec2(0), 0).x, 0u, 0u, 0u);
}
