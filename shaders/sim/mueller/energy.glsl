// Energy of compression over m c^2, for x = rho / rho0 - 1: mueller_energy of sim/methods/mueller/mueller.c.
float compression_energy(float x)
{
    if (abs(x) > 0.1)
        return log(1.0 + x) - x / (1.0 + x);
    float sum = 0.0; // a series, where the two terms nearly cancel
    for (int n = 8; n >= 2; n--)
        sum = float(n - 1) / float(n) - x * sum;
    return x * x * sum;
}
