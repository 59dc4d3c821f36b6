// An iteration of a solver: Jacobi's step and a part, MOMENTUM, of the step before. A pass declares dt.

// The k behind the k of now, by 1 / D and by how k changed in the iteration before.
float next_term(float k, float residual, float factor, float change)
{
    float relaxed = dt > 0.0 ? relaxation * rest_number_density / (dt * dt) : 0.0;
    float momentum = dt > 0.0 ? MOMENTUM : 0.0;
    float next = k + relaxed * residual * factor + momentum * change;
#ifndef NEGATIVE_PRESSURE
    next = next > 0.0 ? next : 0.0;
#endif
    return next;
}

// How far a residual is from where it is to be: of what k holds, on either side; else above 0.
float miss_of(float residual, float k)
{
#ifdef NEGATIVE_PRESSURE
    return abs(residual);
#else
    return k > 0.0 ? abs(residual) : residual < 0.0 ? 0.0 : residual;
#endif
}
