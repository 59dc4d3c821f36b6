// Unpolarised light from air. After: Fresnel; Born and Wolf, Principles of optics, 1.5.2.
float fresnel(float cosine, float ior)
{
    float inner = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior)); // Snell
    float s = (cosine - ior * inner) / (cosine + ior * inner), p = (ior * cosine - inner) / (ior * cosine + inner);
    return 0.5 * (s * s + p * p);
}
