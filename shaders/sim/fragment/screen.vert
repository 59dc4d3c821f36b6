#include "common/screen.vert"
