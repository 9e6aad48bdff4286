// The 2D kernels. Bodies: kernels.isph.
#define DIM 2
#include "kernels.isph"
#include "cells.isph"
#include "viscosity.isph"
#include "primal.isph"
#include "flight.isph"

export void scatter2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    scatter_blocks(*args, begin, end);
}
export void predict_nodes2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    predict_node_blocks(*args, begin, end);
}
export void iterate2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    iterate_blocks(*args, begin, end);
}
export void update_nodes2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    update_node_blocks(*args, begin, end);
}
export void integrate2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    integrate_blocks(*args, begin, end);
}
export void fly2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    fly_blocks(*args, begin, end);
}
export void drift2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    drift_blocks(*args, begin, end);
}
export void dual_begin2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    dual_begin_blocks(*args, begin, end);
}
export void dual_iterate2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    dual_iterate_blocks(*args, begin, end);
}
export void push_nodes2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    push_node_blocks(*args, begin, end);
}
export void cells_begin2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_begin_blocks(*args, begin, end);
}
export void cells_mean2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_mean_blocks(*args, begin, end);
}
export void solids_begin2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    solids_begin_blocks(*args, begin, end);
}
export void solids_mean2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    solids_mean_blocks(*args, begin, end);
}
export void cells_push2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_push_blocks(*args, begin, end);
}
export void cells_carry2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_carry_blocks(*args, begin, end);
}
export void cells_add2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_add_blocks(*args, begin, end);
}
export void cells_trace2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_trace_blocks(*args, begin, end);
}
export void second_order2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    second_order_blocks(*args, begin, end);
}
export void cells_update2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_update_blocks(*args, begin, end);
}
export void viscous2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    viscous_blocks(*args, begin, end);
}
export void viscous_nodes2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    viscous_node_blocks(*args, begin, end);
}
export void respond_nodes2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    respond_node_blocks(*args, begin, end);
}
export void cells_respond2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_respond_blocks(*args, begin, end);
}
export void force_first2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    force_first_blocks(*args, begin, end);
}
export void force2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    force_blocks(*args, begin, end);
}
export void force_nodes2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    force_node_blocks(*args, begin, end);
}
export void hold_pressure2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    hold_pressure_blocks(*args, begin, end);
}
export void end_sketch2(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    end_sketch_blocks(*args, begin, end);
}
