#!/usr/bin/env python3
"""Two gaits at once with asyncio: the same walk at draft and at standard accuracy, and what the difference is."""
import asyncio

import rollgait


async def main() -> None:
    async with rollgait.AsyncClient() as client:
        draft, standard = await asyncio.gather(client.solve("planar", accuracy="draft"),
                                               client.solve("planar", accuracy="standard"))
    print(f"draft     {draft.objective:.6g} ({draft.verdict}, {draft.iterations} iterations)")
    print(f"standard  {standard.objective:.6g} ({standard.verdict}, {standard.iterations} iterations)")
    print(f"difference {100 * (draft.objective / standard.objective - 1):+.2f} %")


asyncio.run(main())
