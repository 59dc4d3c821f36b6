// Energy of compression over m c^2, for x = rho / rho0 - 1: wcsph_energy of sim/methods/wcsph/wcsph.c.
float compression_energy(float x)
{
    return x * x * (2.5 + x * (10.0 / 3.0 + x * (2.5 + x * (1.0 + x / 6.0))) + 1.0 / (1.0 + x)) / 7.0;
}
