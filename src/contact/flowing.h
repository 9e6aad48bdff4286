/* Liquid and sand around a node: what presses on walls. */
#ifndef PBMPM_SRC_CONTACT_FLOWING_H
#define PBMPM_SRC_CONTACT_FLOWING_H

#include "contact/contacts.h"

/* A node of the grid by its block and where it lies in it. */
typedef struct FlowingSite {
    const ContactFrame *frame; /* frame->pressed is not null */
    int32_t block;
    int local[3];
} FlowingSite;

/* The mean of p / rho around the node [cells^2 / substep^2]: of single particles it is noise. */
double flowing_pressure(const FlowingSite *site);

/* What an even pressure of 1 pushes the node with [m^3 / cell]: - sum_p V_p grad w_p, V the volume of particles at rest. */
void flowing_push(const FlowingSite *site, double push[3]);

#endif
