// Pictures of the page, to be looked at.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { screenshots } from './environment';

export async function screenshot(page: Page, name: string): Promise<void> {
  if (screenshots === undefined) return;
  mkdirSync(screenshots, { recursive: true });
  const size = page.viewportSize();
  await page.screenshot({ path: join(screenshots, `${name}-${size?.width}x${size?.height}.png`) });
}
