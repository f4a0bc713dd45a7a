// Never compiled: check_stages.cmake must refuse this include.
#include "circlepoint/simulation/simulate.hpp"
