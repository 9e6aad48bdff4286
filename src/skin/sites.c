#include "skin/sites.h"

#include "grid/grid.h"

/* The end of the rows from one on that count and are in the site. */
static uint32_t follow_rows(Site *site, const SkinMatter *matter, int subdivision, uint32_t row)
{
    const Particles *p = matter->particles;
    const uint32_t cells = (uint32_t)lattice_cells(subdivision);
    uint32_t found[3] = {0}, first[3];
    for (int a = 0; a < 3; a++) first[a] = (uint32_t)lattice_first(subdivision, site->place[a]);
    for (; row < p->count && matter_has(matter, row); row++) {
        const uint32_t x = (uint32_t)p->cell[0][row] - first[0], y = (uint32_t)p->cell[1][row] - first[1], z = (uint32_t)p->cell[2][row] - first[2];
        if ((x | y | z) >= cells) break; /* cells is a power of two */
        found[0] |= 1u << x;
        found[1] |= 1u << y;
        found[2] |= 1u << z;
    }
    for (int a = 0; a < 3; a++) site->cells[a] |= (uint8_t)found[a];
    return row;
}

static int32_t site_of(Sites *sites, Memory *memory, const Particles *p, int subdivision, uint32_t row)
{
    int32_t place[3];
    for (int a = 0; a < 3; a++) place[a] = lattice_place(subdivision, p->cell[a][row]);
    return places_want(&sites->site, memory, place);
}

static bool find_runs(Sites *sites, Memory *memory, const SkinMatter *matter, int subdivision)
{
    uint32_t row = 0;
    while (row < matter->particles->count) {
        if (!matter_has(matter, row)) {
            row++;
            continue;
        }
        SiteRun run = {site_of(sites, memory, matter->particles, subdivision, row), row, row};
        if (run.site == GRID_NOWHERE) return false;
        Site *site = sites_at(sites, run.site);
        run.end = row = follow_rows(site, matter, subdivision, row);
        site->runs++;
        site->volume += (float)(run.end - run.begin) * matter_volume(matter, run.begin);
        const size_t count = (size_t)sites->runs++;
        if (!array_grow(memory, &sites->found, count + 1, sizeof run, count * sizeof run)) return false;
        ((SiteRun *)sites->found.data)[count] = run;
    }
    return true;
}

/* What it takes for more than spray [cells]: drops of fewer particles are better drawn as points. */
static const float SPRAY_MOST = 1.0f;

static bool is_spray(const Sites *sites, const Site *site)
{
    float volume = site->volume;
    for (int n = 0; n < BLOCK_NEIGHBOURS && volume < SPRAY_MOST; n++) {
        int32_t place[3];
        if (n == BLOCK_NEIGHBOURS / 2) continue; /* that is itself */
        grid_neighbour_offset(n, 3, place);
        for (int a = 0; a < 3; a++) place[a] += site->place[a];
        const int32_t other = places_find(&sites->site, place);
        if (other != GRID_NOWHERE) volume += sites_at(sites, other)->volume;
    }
    return volume < SPRAY_MOST;
}

/* Site by site, each in the order of rows. */
static bool sort_runs(Sites *sites, Memory *memory)
{
    if (!array_reserve(memory, &sites->run, (size_t)sites->runs, sizeof(SiteRun))) return false;
    uint32_t first = 0;
    for (int32_t s = 0; s < sites->site.count; s++) {
        Site *site = sites_at(sites, s);
        site->spray = is_spray(sites, site);
        site->first_run = first;
        first += site->spray ? 0 : site->runs;
        site->runs = 0;
    }
    const SiteRun *found = sites->found.data;
    for (int32_t r = 0; r < sites->runs; r++) {
        Site *site = sites_at(sites, found[r].site);
        if (!site->spray) ((SiteRun *)sites->run.data)[site->first_run + site->runs++] = found[r];
    }
    return true;
}

bool sites_find(Sites *sites, Memory *memory, const SkinMatter *matter, int subdivision)
{
    sites->site.size = sizeof(Site);
    places_clear(&sites->site);
    sites->runs = 0;
    return find_runs(sites, memory, matter, subdivision) && sort_runs(sites, memory);
}

void sites_free(Sites *sites, Memory *memory)
{
    places_free(&sites->site, memory);
    array_free(memory, &sites->found);
    array_free(memory, &sites->run);
}
