// Evenly distributed noise over the pixels, 0..1; after Jimenez, Next generation post processing in Call of Duty, 2014.
float pixel_noise(vec2 pixel)
{
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}
