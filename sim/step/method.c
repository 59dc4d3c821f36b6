/* Lists of the methods and of the shared terms, and queries over these lists. Outside of their folders,
   methods and terms are named only here. */
#include "sim/step/method.h"

#include <assert.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

extern const Term term_viscosity, term_change;

const Term *const shared_terms[] = {&term_viscosity, &term_change, NULL};

extern const Method method_mueller, method_wcsph, method_dfsph, method_pbf;

static const Method *methods[METHODS_MAX + 1] = {&method_mueller, &method_wcsph, &method_dfsph, &method_pbf};

static int method_index(const Method *method)
{
    int at = 0;
    while (methods[at] && methods[at] != method)
        at++;
    return at;
}

void method_add(const Method *method)
{
    const int at = method_index(method);
    assert(at < METHODS_MAX && method->def_size <= METHOD_DEF_SIZE);
    methods[at] = method;
}

const Method *const *method_list(void)
{
    return methods;
}

const Method *method_find(const char *name)
{
    for (int i = 0; methods[i]; i++)
        if (strcmp(methods[i]->name, name) == 0)
            return methods[i];
    return NULL;
}

const MethodSolver *solver_of(const Method *method, int solve)
{
    const Term *const *term = shared_terms;
    if (solve < SOLVES_OF_METHOD)
        return &method->solvers[solve];
    while (*term && (*term)->solve != solve)
        term++;
    return *term ? &(*term)->solver : NULL;
}

MethodKernels method_kernels(const WorldDef *def)
{
    const Method *method = method_find(def->method);
    const Kernel *spiky = density_kernel_find("spiky");
    return method->kernels ? method->kernels(def) : (MethodKernels){spiky, spiky};
}

void *method_def(const WorldDef *def, const Method *method)
{
    const int at = method_index(method);
    return at < METHODS_MAX ? (void *)(uintptr_t)&def->of_method[at] : NULL;
}

void methods_default(WorldDef *def)
{
    for (int i = 0; methods[i]; i++)
        if (methods[i]->def_size > 0)
            memcpy(&def->of_method[i], methods[i]->def, methods[i]->def_size);
}

void method_say(const MethodAdvice *advice, const char *key, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    advice->say(advice->to, key, what);
}
