// seam-render: recordings to pictures.

#include "render/commands.h"

int main(int argc, char** argv) { return seam::RenderMain(argc, argv); }
