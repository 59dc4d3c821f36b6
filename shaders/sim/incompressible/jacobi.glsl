// An iteration of a solver: Jacobi's step plus MOMENTUM times the step before. A pass declares dt.

// The next k, from the present k, 1 / D and the change of k in the iteration before.
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

// Error of a residual: on either side where k holds; else only above 0.
float miss_of(float residual, float k)
{
#ifdef NEGATIVE_PRESSURE
    return abs(residual);
#else
    return k > 0.0 ? abs(residual) : residual < 0.0 ? 0.0 : residual;
#endif
}
