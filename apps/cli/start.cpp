#include "program.h"

int main(int argc, char** argv) { return regionmesh::cli::run_program(argc, argv); }
