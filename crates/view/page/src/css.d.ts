// Style sheets are gathered by the build; they have no values.
declare module "*.css";
