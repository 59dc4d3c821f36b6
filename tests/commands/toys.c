/* The program with a method, a view, an effect, a command, formats, an experiment and an action that it does
   not have: each adds itself, and no other file knows it. */
#include "tests/app/toy_action.h"
#include "tests/app/toy_command.h"
#include "tests/app/toy_experiment.h"
#include "tests/app/toy_format.h"
#include "tests/render/toy_effect.h"
#include "tests/render/toy_view.h"
#include "tests/sim/toy_method.h"

static __attribute__((constructor)) void add(void)
{
    toy_method_add();
    toy_view_add();
    toy_effect_add();
    toy_command_add();
    toy_format_add();
    toy_experiment_add();
    toy_action_add();
}
