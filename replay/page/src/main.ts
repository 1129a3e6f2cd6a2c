/** Begins the page that the data are for: what it is made of stands in a template of the same name. */
import { get } from "./elements.ts";
import { MeshPage } from "./mesh/mesh_page.ts";
import { ReplayPage } from "./replay/replay_page.ts";
import { TowerPage } from "./tower/tower_page.ts";

type Page = new (data: any) => unknown;

const pages: Record<string, Page> = { mesh: MeshPage, replay: ReplayPage, tower: TowerPage };

const data = JSON.parse(get("data").textContent ?? "") as { kind: string };
get("page").replaceChildren(get<HTMLTemplateElement>(`${data.kind}-page`).content);
new pages[data.kind](data);
